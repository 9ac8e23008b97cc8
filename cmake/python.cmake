# What the Python module needs, where it is there.
if(NOT DEFINED Python_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python_EXECUTABLE /usr/bin/python3)  # Debian's, which python3-dev and python3-numpy belong to
endif()
find_package(Python COMPONENTS Interpreter Development.Module)
set(PYBIND11_FINDPYTHON ON)
find_package(pybind11 CONFIG QUIET)
if(Python_Development.Module_FOUND AND pybind11_FOUND)
  add_subdirectory(apps/python)
else()
  message(STATUS "No Python module: it needs pybind11-dev and python3-dev")
endif()
