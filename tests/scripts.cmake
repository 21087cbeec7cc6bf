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
            ${CMAKE_CXX_COMPILER})
script_test(structure.files_stay_small ${structure}/files_stay_small.py ${PROJECT_SOURCE_DIR})
script_test(structure.layout_is_clang_format ${structure}/layout_is_clang_format.py ${PROJECT_SOURCE_DIR})
