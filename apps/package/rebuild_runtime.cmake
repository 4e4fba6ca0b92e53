# SPDX-License-Identifier: MIT
# Run by cpack after it has packed: CPack's package of a shared library has scripts that call ldconfig, which Debian's dpkg
# does by the trigger. Without dpkg-deb the package stays as it is.
find_program(DPKG_DEB dpkg-deb)
if(NOT CPACK_GENERATOR STREQUAL "DEB" OR NOT DPKG_DEB)
  return()
endif()
foreach(package ${CPACK_PACKAGE_FILES})
  if(NOT package MATCHES "/libsunder[0-9]+_[^/]*\\.deb$")
    continue()
  endif()
  set(root ${package}.root)
  execute_process(COMMAND ${DPKG_DEB} -R ${package} ${root} COMMAND_ERROR_IS_FATAL ANY)
  file(REMOVE ${root}/DEBIAN/postinst ${root}/DEBIAN/postrm)
  execute_process(COMMAND ${DPKG_DEB} --root-owner-group -Zxz --build ${root} ${package} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  file(REMOVE_RECURSE ${root})
endforeach()
