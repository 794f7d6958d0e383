# Debian packages: CPack makes one for each component that cmake/install.cmake installs. `image_build/packages` builds them.
# image_build/debian has the files that only packages need.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME frustumscreen)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_INSTALL_PREFIX /usr)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_SET_DESTDIR ON) # the install rules have absolute paths: /usr/lib/systemd, /etc
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL base kiosk bake)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS # independent of the builder's umask
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON) # packages are made without building the tests

set(debian ${CMAKE_SOURCE_DIR}/image_build/debian)
set(FRUSTUMSCREEN_MAINTAINER "FrustumScreen maintainers <maintainers@frustumscreen.invalid>" CACHE STRING
    "who answers for the packages: name and address, for their control file")
set(CPACK_DEBIAN_PACKAGE_MAINTAINER ${FRUSTUMSCREEN_MAINTAINER})
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT) # NAME_VERSION_ARCHITECTURE.deb
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON) # frustumscreen-base of the same version
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_SOURCE_DIR}/cmake/package_documents.cmake)
set(CPACK_FRUSTUMSCREEN_SOURCE ${CMAKE_SOURCE_DIR}) # for package_documents.cmake
set(CPACK_FRUSTUMSCREEN_PROGRAMS ${CMAKE_RUNTIME_OUTPUT_DIRECTORY})

# frustumscreen_package(COMPONENT NAME SECTION DEPENDS "..." RECOMMENDS "..."): dependencies on linked libraries are added automatically.
macro(frustumscreen_package component name section)
    cmake_parse_arguments(PACKAGE "" "" "DEPENDS;RECOMMENDS;SUGGESTS" ${ARGN})
    string(TOUPPER ${component} COMPONENT)
    set(CPACK_DEBIAN_${COMPONENT}_PACKAGE_NAME ${name})
    set(CPACK_DEBIAN_${COMPONENT}_PACKAGE_SECTION ${section})
    foreach(kind DEPENDS RECOMMENDS SUGGESTS)
        list(JOIN PACKAGE_${kind} ", " CPACK_DEBIAN_${COMPONENT}_PACKAGE_${kind})
    endforeach()
    file(READ ${debian}/${component}/description CPACK_COMPONENT_${COMPONENT}_DESCRIPTION)
    file(GLOB CPACK_DEBIAN_${COMPONENT}_PACKAGE_CONTROL_EXTRA CONFIGURE_DEPENDS
        ${debian}/${component}/conffiles ${debian}/${component}/p*inst ${debian}/${component}/p*rm)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${debian}/${component}/description)
endmacro()

frustumscreen_package(base frustumscreen-base graphics DEPENDS
    libegl-mesa0       # Mesa's EGL, which libegl1 opens by name
    libgl1-mesa-dri    # Mesa's drivers, which that opens by name
    fonts-dejavu-core  # sets captions for which a pack has no glyphs
    tzdata)            # the exhibit's hours, in any zone
frustumscreen_package(kiosk frustumscreen graphics DEPENDS
    "systemd (>= 252)" # runs the units, makes users and folders, mounts sticks
    udev               # its rules give devices to groups, and start an import for a stick
    mount              # frustumscreen-ntfs@ mounts a stick
    ntfs-3g            # reads it for that
    RECOMMENDS
    alsa-utils)        # alsamixer, aplay, speaker-test: docs/technicians.md, The sound
frustumscreen_package(bake frustumscreen-bake graphics DEPENDS
    libegl-mesa0 libgl1-mesa-dri # as above: --preview and frustumscreen-window draw
    fonts-noto-core    # sets texts in all languages but Chinese, Japanese and Korean; the bake opens no other typeface
    RECOMMENDS
    espeak-ng          # speaks what has no recording; without it, --speech names another voice
    fonts-noto-cjk     # Chinese, Japanese, Korean
    SUGGESTS
    minisign)          # its keys serve frustumscreen-pack, too
set(CPACK_COMPONENT_KIOSK_DEPENDS base)
set(CPACK_COMPONENT_BAKE_DEPENDS base)
include(CPack)
