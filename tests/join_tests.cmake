# SPDX-License-Identifier: MIT
# Writes one source that holds several tests, each in a namespace of its own: `cmake -DOUT=FILE -DTESTS=A;B -P join_tests.cmake`.
# What they include comes first, outside of the namespaces; include guards make it nothing within them.
set(includes "")
set(bodies "")
set(number 0)
foreach(test ${TESTS})
  file(STRINGS ${test} lines REGEX "^#include")
  list(APPEND includes ${lines})
  string(APPEND bodies "namespace test_file_${number} {\n#include \"${test}\"\n}\n")
  math(EXPR number "${number} + 1")
endforeach()
list(REMOVE_DUPLICATES includes)
list(JOIN includes "\n" includes)
file(WRITE ${OUT} "${includes}\n${bodies}")
