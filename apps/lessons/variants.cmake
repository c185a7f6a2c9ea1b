# Variants of the lessons with the changes that their pages show. They are not built by default. scripts/docs/lesson_pictures.py runs them.
find_package(Python3 COMPONENTS Interpreter)
add_custom_target(lesson-variants)
if(NOT Python3_FOUND)
  return()
endif()
set(script ${PROJECT_SOURCE_DIR}/scripts/docs/lesson_pictures.py)
set(pages ${PROJECT_SOURCE_DIR}/docs/tutorial/lessons)
foreach(lesson ${lessons})
  string(REPLACE "lesson-" "" name ${lesson})
  string(SUBSTRING ${name} 0 2 number)
  foreach(variant wrong solution)
    set(source ${CMAKE_CURRENT_BINARY_DIR}/lessons/${name}-${variant}.cpp)
    add_custom_command(OUTPUT ${source}
      COMMAND ${CMAKE_COMMAND} -E make_directory ${CMAKE_CURRENT_BINARY_DIR}/lessons
      COMMAND ${Python3_EXECUTABLE} ${script} write ${name} ${variant} ${source}
      DEPENDS ${script} ${CMAKE_CURRENT_SOURCE_DIR}/lessons/${name}.cpp ${pages}/${number}.md
        ${PROJECT_SOURCE_DIR}/docs/teachers/solutions.md)
    add_executable(${lesson}-${variant} EXCLUDE_FROM_ALL ${source})
    get_target_property(libraries ${lesson} LINK_LIBRARIES)
    if(libraries)
      target_link_libraries(${lesson}-${variant} PRIVATE ${libraries})
    endif()
    target_compile_options(${lesson}-${variant} PRIVATE $<$<CONFIG:Release>:-O1> -w)  # a change may leave a variable unused
    add_dependencies(lesson-variants ${lesson}-${variant})
  endforeach()
endforeach()
