# tests/ mirrors src/: one program per folder, plus laws/ (promises that span modules), faults/ (bad input,
# full disks) and world/ (what other programs make of our files).
include(GoogleTest)
function(brisance_tests folder)
  cmake_parse_arguments(ARG "" "" "USES;LIBRARIES" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/tests/${folder}/*_test.cpp)
  if(NOT sources)
    return()
  endif()
  add_executable(test_${folder} ${sources})
  target_include_directories(test_${folder} PRIVATE ${CMAKE_SOURCE_DIR}/tests)
  foreach(used ${ARG_USES})
    target_link_libraries(test_${folder} PRIVATE brisance_${used})
  endforeach()
  target_link_libraries(test_${folder} PRIVATE ${ARG_LIBRARIES} GTest::gtest_main)
  target_compile_definitions(test_${folder} PRIVATE
    BRISANCE_SOURCE_DIR="${CMAKE_SOURCE_DIR}" BRISANCE_BINARY="${CMAKE_BINARY_DIR}/bin/brisance")
  gtest_discover_tests(test_${folder} DISCOVERY_MODE PRE_TEST PROPERTIES TIMEOUT 1800)  # those of --long draw films
endfunction()

foreach(folder base grid mesh particles rigid fracture frame simulation render scene view)
  brisance_tests(${folder} USES ${folder} sample_meshes
    LIBRARIES nlohmann_json::nlohmann_json Eigen3::Eigen PkgConfig::OPENEXR)
endforeach()
brisance_tests(fluid USES fluid sample_meshes textbook_flows LIBRARIES nlohmann_json::nlohmann_json)
brisance_tests(assets USES fracture sample_meshes)
brisance_tests(laws USES scene sample_meshes LIBRARIES nlohmann_json::nlohmann_json)
brisance_tests(faults USES scene LIBRARIES nlohmann_json::nlohmann_json)
brisance_tests(world USES scene LIBRARIES nlohmann_json::nlohmann_json PkgConfig::OPENEXR)
foreach(folder laws faults world)
  if(TARGET test_${folder})
    add_dependencies(test_${folder} brisance)
  endif()
endforeach()

# The player in a browser, and exports in the hands of others (npm's packages lie where the player was bundled).
if(NODE_PROGRAM AND NPM_PROGRAM)
  foreach(name chromium exchange)
    add_test(NAME Player.${name} COMMAND ${NODE_PROGRAM} ${CMAKE_SOURCE_DIR}/tests/world/player/${name}_test.mjs
      ${CMAKE_BINARY_DIR}/bin/brisance ${PLAYER_FOLDER})
    set_tests_properties(Player.${name} PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 900)
  endforeach()
else()
  message(STATUS "Tests of the player are left out: Node.js or npm is missing (packaging/build.txt)")
endif()

# Tests in Python's unittest: every class of a file that has one of the bases, and is none, becomes the test PREFIX.CLASS.
find_package(Python COMPONENTS Interpreter)
function(brisance_unittest prefix file bases)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/tests/${file})
  get_filename_component(module ${file} NAME_WE)
  get_filename_component(folder ${file} DIRECTORY)
  file(STRINGS ${CMAKE_SOURCE_DIR}/tests/${file} classes REGEX "^class [A-Z][A-Za-z]*\\((${bases})\\)")
  foreach(line ${classes})
    string(REGEX REPLACE "^class ([A-Za-z]+).*" "\\1" class ${line})
    if(class MATCHES "^(${bases})$")
      continue()
    endif()
    add_test(NAME ${prefix}.${class} COMMAND ${Python_EXECUTABLE} -m unittest -v ${module}.${class}
      WORKING_DIRECTORY ${CMAKE_SOURCE_DIR}/tests/${folder})
    set_tests_properties(${prefix}.${class} PROPERTIES TIMEOUT 600 ENVIRONMENT
      "PYTHONPATH=${CMAKE_BINARY_DIR}/python;PYTHONDONTWRITEBYTECODE=1;BRISANCE_SOURCE_DIR=${CMAKE_SOURCE_DIR};BRISANCE_BINARY=${CMAKE_BINARY_DIR}/bin/brisance")
  endforeach()
endfunction()

if(Python_FOUND)
  brisance_unittest(Farm farm/farm_test.py "Farm|unittest.TestCase")
  set_tests_properties(Farm.Slurm PROPERTIES TIMEOUT 3600)  # with the long test, a whole film twice
  brisance_unittest(Shell shell/shell_test.py unittest.TestCase)
  brisance_unittest(Docs docs/site_test.py unittest.TestCase)
  brisance_unittest(Docs docs/tutorial_test.py unittest.TestCase)
  set_tests_properties(Docs.Tutorial PROPERTIES TIMEOUT 3600)  # likewise
endif()
if(TARGET brisance_python)
  execute_process(COMMAND ${Python_EXECUTABLE} -c "import numpy" RESULT_VARIABLE missing OUTPUT_QUIET ERROR_QUIET)
  if(missing)
    message(STATUS "No tests of the Python module: they need NumPy")
  else()
    brisance_unittest(Python python/python_test.py "Scratch|unittest.TestCase")
    brisance_unittest(Python python/pages_test.py unittest.TestCase)
    brisance_unittest(Python python/pip_test.py unittest.TestCase)
    set_tests_properties(Python.PipInstall PROPERTIES TIMEOUT 3600)  # where BRISANCE_LONG_TESTS is set it builds all anew
  endif()
endif()
