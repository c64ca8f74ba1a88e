# What an installation has, and the Debian package of it (toolchain/package). The drivers lie where the system's
# OpenNI2 looks, so every OpenNI2 program has them.
include(GNUInstallDirs)
set(multiarch ${CMAKE_LIBRARY_ARCHITECTURE})
set(doc ${CMAKE_INSTALL_DATADIR}/doc/touchstone)
set(packaging ${PROJECT_SOURCE_DIR}/toolchain/debian)

install(TARGETS touchstone RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
foreach(driver TouchstoneKinect TouchstoneSequence TouchstoneSimulator)
    install(TARGETS ${driver} LIBRARY DESTINATION lib/${multiarch}/OpenNI2/Drivers)
endforeach()
install(FILES systemd/touchstone.service systemd/touchstone-fallback.service systemd/touchstone-factory-reset.service
    systemd/touchstone-retry.timer
    DESTINATION lib/systemd/system)
install(FILES platform/usb/70-touchstone-depth-cameras.rules platform/usb/70-touchstone-uinput.rules
    DESTINATION lib/udev/rules.d)
install(FILES systemd/touchstone.toml DESTINATION /etc/touchstone)
install(FILES toolchain/completion/touchstone.bash RENAME touchstone
    DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES toolchain/completion/_touchstone DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
install(FILES docs/handbook.md docs/touchstone.toml CHANGELOG.md ${packaging}/copyright DESTINATION ${doc})
install(DIRECTORY examples/web examples/table DESTINATION ${doc}/examples PATTERN node_modules EXCLUDE)

# Compressed without a time of their own: the same source gives the same package.
find_program(GZIP gzip REQUIRED)
set(compressed ${PROJECT_BINARY_DIR}/compressed)
file(MAKE_DIRECTORY ${compressed})
function(touchstone_install_compressed source name folder)
    add_custom_command(OUTPUT ${compressed}/${name} COMMAND ${GZIP} -9nc ${source} > ${compressed}/${name} DEPENDS ${source} VERBATIM)
    set_property(GLOBAL APPEND PROPERTY touchstone_compressed ${compressed}/${name})
    install(FILES ${compressed}/${name} DESTINATION ${folder})
endfunction()
touchstone_install_compressed(${PROJECT_SOURCE_DIR}/docs/touchstone.1 touchstone.1.gz ${CMAKE_INSTALL_MANDIR}/man1)
touchstone_install_compressed(${packaging}/changelog changelog.gz ${doc})
get_property(compressed_files GLOBAL PROPERTY touchstone_compressed)
add_custom_target(touchstone_compressed_files ALL DEPENDS ${compressed_files})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME touchstone)
set(CPACK_PACKAGE_VENDOR Touchstone)
set(CPACK_PACKAGE_CONTACT "Touchstone maintainers <maintainers@touchstone.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "multi-touch on any surface under a depth camera")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "Scans what a fixed depth camera sees, follows the hands that move
in front of it and finds where fingers touch: on tables, ridges,
bowls, piles of books. It draws a touch-driven picture on a screen
or a calibrated projector, and sends the touches by TUIO,
WebSocket or as those of a touch screen.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION misc)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
if(CMAKE_CROSSCOMPILING)
    set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE ${TOUCHSTONE_DEBIAN_ARCHITECTURE})
    set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_SYSROOT}/usr/lib/${multiarch})
endif()
# Named by no library: compute, drawing, drivers of OpenNI2, fonts.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "pocl-opencl-icd | opencl-icd, libegl-mesa0, libgl1-mesa-dri, libopenni2-0, fonts-inter, fonts-dejavu-core")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "udev, libfreenect0.5")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS chromium)
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA
    "${packaging}/conffiles;${packaging}/postinst;${packaging}/prerm;${packaging}/postrm")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
include(CPack)
