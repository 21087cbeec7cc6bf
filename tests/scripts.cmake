# Tests written as scripts, labelled `script`: the structure of the tree, the command line, files that others judge.
# Exit status 77 means skipped, with the reason printed.
find_package(Python3 REQUIRED COMPONENTS Interpreter)

function(script_test name)
  add_test(NAME ${name} COMMAND ${Python3_EXECUTABLE} -B ${ARGN})
  set_tests_properties(${name} PROPERTIES LABELS script SKIP_RETURN_CODE 77 TIMEOUT 600)
endfunction()

set(structure ${CMAKE_CURRENT_SOURCE_DIR}/structure)
script_test(structure.rules_can_fail ${structure}/rules_can_fail.py)
script_test(structure.includes_point_inward ${structure}/includes_point_inward.py ${PROJECT_SOURCE_DIR})
script_test(structure.headers_are_our_own ${structure}/headers_are_our_own.py ${PROJECT_SOURCE_DIR})
script_test(structure.headers_compile_alone ${structure}/headers_compile_alone.py ${PROJECT_SOURCE_DIR}
            ${CMAKE_CXX_COMPILER} ${CMAKE_CURRENT_BINARY_DIR}/headers_alone)
script_test(structure.files_stay_small ${structure}/files_stay_small.py ${PROJECT_SOURCE_DIR})
script_test(structure.links_lead_somewhere ${structure}/links_lead_somewhere.py ${PROJECT_SOURCE_DIR})
script_test(structure.layout_is_clang_format ${structure}/layout_is_clang_format.py ${PROJECT_SOURCE_DIR})

# What needs the program, and with it everything below it.
if(TARGET mien_cli)
  script_test(structure.headers_have_tests ${structure}/headers_have_tests.py ${PROJECT_SOURCE_DIR})

  set(program "MIEN=$<TARGET_FILE:mien_cli>")
  script_test(cli.promises ${CMAKE_CURRENT_SOURCE_DIR}/cli/cli_test.py)
  script_test(cli.examples ${CMAKE_CURRENT_SOURCE_DIR}/cli/examples_test.py)
  script_test(cli.written_files_are_valid ${CMAKE_CURRENT_SOURCE_DIR}/cli/written_files_are_valid.py)
  script_test(cli.face_animation ${CMAKE_CURRENT_SOURCE_DIR}/cli/fap_test.py)
  script_test(cli.face_animation_tables ${CMAKE_CURRENT_SOURCE_DIR}/cli/fat_test.py)
  script_test(cli.pictures ${CMAKE_CURRENT_SOURCE_DIR}/cli/render_test.py)
  set_tests_properties(cli.promises cli.examples cli.face_animation cli.face_animation_tables cli.pictures cli.written_files_are_valid PROPERTIES ENVIRONMENT ${program})
  script_test(cli.evaluate ${CMAKE_CURRENT_SOURCE_DIR}/cli/evaluate_test.py)
  script_test(cli.shapes ${CMAKE_CURRENT_SOURCE_DIR}/cli/shapes_test.py)
  set_tests_properties(cli.evaluate cli.shapes PROPERTIES ENVIRONMENT ${program})

  # The README's fragment: compiled and linked as it stands, and run beside the samples it names.
  set(fragment ${CMAKE_CURRENT_BINARY_DIR}/readme)
  file(MAKE_DIRECTORY ${fragment})
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/samples ${fragment}/samples SYMBOLIC)
  add_custom_command(
    OUTPUT ${fragment}/readme.cpp
    COMMAND ${Python3_EXECUTABLE} -B ${structure}/readme_fragment.py ${PROJECT_SOURCE_DIR}/README.md
            ${fragment}/readme.cpp
    DEPENDS ${PROJECT_SOURCE_DIR}/README.md ${structure}/readme_fragment.py)
  add_executable(readme_fragment ${fragment}/readme.cpp)
  target_link_libraries(readme_fragment PRIVATE mien_io)
  add_test(NAME structure.readme_fragment_starts_fresh COMMAND ${CMAKE_COMMAND} -E rm -f ${fragment}/sample-performs.glb)
  add_test(NAME structure.readme_fragment_runs COMMAND readme_fragment WORKING_DIRECTORY ${fragment})
  set_tests_properties(structure.readme_fragment_starts_fresh PROPERTIES FIXTURES_SETUP readme LABELS long)
  set_tests_properties(structure.readme_fragment_runs PROPERTIES FIXTURES_REQUIRED readme LABELS long)
endif()
