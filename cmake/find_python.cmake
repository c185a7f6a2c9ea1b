# Searches for pybind11 and NumPy, which the Python module needs, and sets HALFSPACE_PYTHON_FOUND. HALFSPACE_PYTHON=AUTO builds the module
# if they are found. It does not build the module in a subproject, or with sanitizers, because an ordinary interpreter does not load their
# runtime. Python_EXECUTABLE selects the interpreter; the default is the system's interpreter, for which Debian packages install their
# modules.
set(HALFSPACE_PYTHON AUTO CACHE STRING "Build the Python module (needs pybind11 and NumPy): AUTO, ON or OFF")
set_property(CACHE HALFSPACE_PYTHON PROPERTY STRINGS AUTO ON OFF)
set(HALFSPACE_PYTHON_FOUND OFF)
if(NOT HALFSPACE_PYTHON OR (HALFSPACE_PYTHON STREQUAL "AUTO" AND (HALFSPACE_SANITIZE OR NOT PROJECT_IS_TOP_LEVEL)))
  return()
endif()
if(NOT Python_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python_EXECUTABLE /usr/bin/python3)
endif()
find_package(Python 3.9 COMPONENTS Interpreter Development.Module NumPy)
find_package(pybind11 2.10 CONFIG QUIET)
if(Python_FOUND AND pybind11_FOUND)
  set(HALFSPACE_PYTHON_FOUND ON)
elseif(HALFSPACE_PYTHON STREQUAL "AUTO")
  message(STATUS "pybind11 or NumPy was not found: the Python module is not built")
else()
  message(FATAL_ERROR "HALFSPACE_PYTHON=${HALFSPACE_PYTHON} needs pybind11 2.10, NumPy and the headers of Python 3.9 or later "
    "(Debian and Ubuntu: pybind11-dev, python3-numpy, python3-dev)")
endif()
