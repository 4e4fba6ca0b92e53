# SPDX-License-Identifier: MIT
# Run by cpack before it packs: Debian's manual pages and changes are packed by gzip.
if(NOT CPACK_GENERATOR STREQUAL "DEB")
  return()
endif()
string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)  # of SOURCE_DATE_EPOCH, where that is set
file(GLOB_RECURSE manuals "${CPACK_TEMPORARY_DIRECTORY}/*/usr/share/man/*.1")
file(GLOB folders "${CPACK_TEMPORARY_DIRECTORY}/*/usr/share/doc/*")
foreach(folder ${folders})
  cmake_path(GET folder FILENAME package)
  if(EXISTS "${folder}/copyright")
    file(WRITE "${folder}/changelog" "${package} (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium\n\n  * See CHANGELOG.md of the sources.\n\n -- ${CPACK_PACKAGE_CONTACT}  ${now}\n")
    list(APPEND manuals "${folder}/changelog")
  endif()
endforeach()
foreach(manual ${manuals})
  execute_process(COMMAND gzip -9n "${manual}" COMMAND_ERROR_IS_FATAL ANY)
endforeach()
