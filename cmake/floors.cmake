# One library per folder of src/. A folder may use what lies on lower floors (docs/architecture.md);
# tests/laws/include_floors_test.cpp holds the same table and fails on a wrong include.
function(brisance_floor folder)
  cmake_parse_arguments(ARG "" "" "USES;LIBRARIES" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/src/${folder}/*.cpp)
  if(NOT sources)
    add_library(brisance_${folder} INTERFACE)
    set(scope INTERFACE)
  else()
    add_library(brisance_${folder} STATIC ${sources})
    set(scope PUBLIC)
    target_link_libraries(brisance_${folder} PRIVATE ${ARG_LIBRARIES})
    # They become part of the Python module too, which is a shared library.
    set_target_properties(brisance_${folder} PROPERTIES
      POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  endif()
  target_include_directories(brisance_${folder} ${scope} ${CMAKE_SOURCE_DIR}/src)
  foreach(used ${ARG_USES})
    target_link_libraries(brisance_${folder} ${scope} brisance_${used})
  endforeach()
  target_link_libraries(brisance_${folder} ${scope} fmt::fmt)
endfunction()

brisance_floor(base LIBRARIES TBB::tbb PkgConfig::XXHASH)
brisance_floor(grid USES base)
brisance_floor(mesh USES base LIBRARIES Boost::headers Qhull::qhull_r nlohmann_json::nlohmann_json)
brisance_floor(fluid USES grid mesh)
brisance_floor(particles USES grid mesh)
# Nobody asks for errno or floating-point traps there: without them square roots and choices become vectors. No bit changes.
foreach(source particles/particle_step fluid/advection fluid/closing_sweep fluid/diffusion fluid/flow_findings fluid/ghost_rows fluid/projection fluid/scalar_sweep
    fluid/semi_lagrangian fluid/temperature fluid/velocity_sweep fluid/vorticity render/gas_bricks render/gas_medium render/gas_tracking)
  set_source_files_properties(${CMAKE_SOURCE_DIR}/src/${source}.cpp PROPERTIES
    COMPILE_OPTIONS "-fno-math-errno;-fno-trapping-math")
endforeach()
# Pictures may differ between instruction sets: the march multiplies and adds at once where it can. Nothing in it is infinite.
set_source_files_properties(${CMAKE_SOURCE_DIR}/src/render/gas_packet.cpp PROPERTIES
  COMPILE_OPTIONS "-fno-math-errno;-fno-trapping-math;-ffp-contract=fast;-ffinite-math-only;-fno-signed-zeros")
brisance_floor(rigid USES grid mesh LIBRARIES bullet_collision)
brisance_floor(fracture USES grid mesh LIBRARIES Eigen3::Eigen Boost::headers TBB::tbb TBB::tbbmalloc)
brisance_floor(frame USES grid mesh LIBRARIES ${OPENVDB_LIBRARY} PkgConfig::BLOSC PkgConfig::IMATH TBB::tbb nlohmann_json::nlohmann_json)
# OpenVDB's registry of grid types lives in its library and in templates made here: the same ones, only if they can be seen.
set_target_properties(brisance_frame PROPERTIES CXX_VISIBILITY_PRESET default VISIBILITY_INLINES_HIDDEN OFF)
target_compile_options(brisance_frame PRIVATE -fno-semantic-interposition)
brisance_floor(simulation USES fluid particles rigid fracture frame LIBRARIES nlohmann_json::nlohmann_json)
brisance_floor(render USES frame LIBRARIES embree PNG::PNG JPEG::JPEG PkgConfig::OPENEXR TBB::tbb nlohmann_json::nlohmann_json)
brisance_floor(view USES frame render LIBRARIES nlohmann_json::nlohmann_json ZLIB::ZLIB Threads::Threads)
brisance_floor(scene USES simulation render LIBRARIES PkgConfig::TOMLPP nlohmann_json::nlohmann_json)
