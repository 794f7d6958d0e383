# CPack runs this script after it has installed into its staging folders and before it packs them. The script adds the files that Debian
# requires of every package under /usr/share/doc, and manual pages made from --help.
set(readable FILE_PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
set(debian ${CPACK_FRUSTUMSCREEN_SOURCE}/image_build/debian)
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC) # SOURCE_DATE_EPOCH if that is set

foreach(component ${CPACK_COMPONENTS_ALL})
    string(TOUPPER ${component} COMPONENT)
    set(name ${CPACK_DEBIAN_${COMPONENT}_PACKAGE_NAME})
    set(stage ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/${component})
    set(documents ${stage}/usr/share/doc/${name})
    file(COPY ${debian}/copyright DESTINATION ${documents} ${readable})
    file(WRITE ${documents}/changelog "${name} (${CPACK_PACKAGE_VERSION}) bookworm; urgency=medium\n\n"
        "  * FrustumScreen ${CPACK_PACKAGE_VERSION}; what is new stands in its CHANGELOG.md.\n\n"
        " -- ${CPACK_DEBIAN_PACKAGE_MAINTAINER}  ${date}\n")
    execute_process(COMMAND gzip -9nf ${documents}/changelog COMMAND_ERROR_IS_FATAL ANY)
    if(EXISTS ${debian}/${component}/lintian-overrides)
        set(overrides ${stage}/usr/share/lintian/overrides)
        file(COPY ${debian}/${component}/lintian-overrides DESTINATION ${overrides} ${readable})
        file(RENAME ${overrides}/lintian-overrides ${overrides}/${name})
    endif()
    file(GLOB programs ${stage}/usr/bin/*)
    foreach(program ${programs})
        get_filename_component(program ${program} NAME)
        execute_process(COMMAND ${CPACK_FRUSTUMSCREEN_SOURCE}/image_build/man_page
            ${CPACK_FRUSTUMSCREEN_PROGRAMS}/${program} ${stage}/usr/share/man/man1 COMMAND_ERROR_IS_FATAL ANY)
    endforeach()
endforeach()
