# Searches for pybind11 and NumPy, which the Python module needs, and sets HALFSPACE_PYTHON_FOUND. It is false in a subproject that does
# not ask for the module, and with sanitizers, whose runtime an ordinary interpreter does not load. Python_EXECUTABLE selects the
# interpreter; the default is the interpreter of the system, for which packages install their modules.
set(HALFSPACE_PYTHON_FOUND OFF)
if(HALFSPACE_PYTHON OR (PROJECT_IS_TOP_LEVEL AND NOT HALFSPACE_SANITIZE))
  if(NOT Python_EXECUTABLE AND EXISTS /usr/bin/python3)
    set(Python_EXECUTABLE /usr/bin/python3)
  endif()
  find_package(Python 3.9 COMPONENTS Interpreter Development.Module NumPy)
  find_package(pybind11 2.10 CONFIG QUIET)
  if(Python_FOUND AND pybind11_FOUND)
    set(HALFSPACE_PYTHON_FOUND ON)
  else()
    message(STATUS "pybind11 or NumPy was not found: the Python module is not built")
  endif()
endif()
