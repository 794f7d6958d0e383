# Installs in three components, each a Debian package (cmake/packages.cmake):
#   base   the exhibit's program and the files that kiosks and curators both use; starts nothing
#   kiosk  the files that turn a PC into the exhibit: units, rules, users, settings; needs base
#   bake   the programs for curators' own computers; needs base
# The paths are those of the units: a kiosk is one image, not a prefix.
set(base_programs frustumscreen frustumscreen-pack frustumscreen-import frustumscreen-calibrate)
set(bake_programs frustumscreen-bake frustumscreen-artifact frustumscreen-poses frustumscreen-sheet)
set(kiosk_programs frustumscreen-watchdog frustumscreen-safe)
if(TARGET frustumscreen-window)
    list(APPEND bake_programs frustumscreen-window)
endif()
# Builds the contents of all packages.
add_custom_target(packaged)
add_dependencies(packaged ${base_programs} ${bake_programs} ${kiosk_programs} frustumscreen-built-in)

install(TARGETS ${base_programs} DESTINATION /usr/bin COMPONENT base EXCLUDE_FROM_ALL)
install(TARGETS ${bake_programs} DESTINATION /usr/bin COMPONENT bake EXCLUDE_FROM_ALL)
install(PROGRAMS assets_baked/batch/slurm_array.sh
    DESTINATION /usr/share/doc/frustumscreen-bake/examples COMPONENT bake EXCLUDE_FROM_ALL)

install(TARGETS ${kiosk_programs} DESTINATION /usr/bin COMPONENT kiosk EXCLUDE_FROM_ALL)
install(FILES systemd/frustumscreen.service systemd/frustumscreen-safe.service
    systemd/frustumscreen-calibrate.path systemd/frustumscreen-calibrate.service
    systemd/frustumscreen-stick@.service systemd/frustumscreen-ntfs@.service
    systemd/frustumscreen-import@.service systemd/frustumscreen-import-refused@.service
    systemd/frustumscreen-watchdog.service systemd/frustumscreen-step@.path systemd/frustumscreen-step@.service
    DESTINATION /usr/lib/systemd/system COMPONENT kiosk EXCLUDE_FROM_ALL)
foreach(unit frustumscreen-import@.service frustumscreen-import-refused@.service) # the same sandbox for both
    install(FILES systemd/frustumscreen-import.sandbox.conf
        DESTINATION /usr/lib/systemd/system/${unit}.d RENAME sandbox.conf COMPONENT kiosk EXCLUDE_FROM_ALL)
endforeach()
install(FILES systemd/frustumscreen-stick-device.conf # for the devices of all sticks
    DESTINATION /usr/lib/systemd/system/dev-frustumscreen-.device.d RENAME pulled.conf COMPONENT kiosk EXCLUDE_FROM_ALL)
install(FILES systemd/70-frustumscreen.rules systemd/71-frustumscreen-stick.rules
    DESTINATION /usr/lib/udev/rules.d COMPONENT kiosk EXCLUDE_FROM_ALL)
install(PROGRAMS systemd/step DESTINATION /usr/lib/frustumscreen COMPONENT kiosk EXCLUDE_FROM_ALL)
install(FILES systemd/frustumscreen.system.conf
    DESTINATION /usr/lib/systemd/system.conf.d RENAME frustumscreen.conf COMPONENT kiosk EXCLUDE_FROM_ALL)
install(FILES systemd/frustumscreen.journald.conf
    DESTINATION /usr/lib/systemd/journald.conf.d RENAME frustumscreen.conf COMPONENT kiosk EXCLUDE_FROM_ALL)
install(FILES systemd/frustumscreen.sysctl
    DESTINATION /usr/lib/sysctl.d RENAME 60-frustumscreen.conf COMPONENT kiosk EXCLUDE_FROM_ALL)
install(FILES systemd/frustumscreen.sysusers
    DESTINATION /usr/lib/sysusers.d RENAME frustumscreen.conf COMPONENT kiosk EXCLUDE_FROM_ALL)
install(FILES systemd/frustumscreen.tmpfiles
    DESTINATION /usr/lib/tmpfiles.d RENAME frustumscreen.conf COMPONENT kiosk EXCLUDE_FROM_ALL)

# The fallback artifact: the amphora with few triangles and small images, so that any machine shows it.
set(built_in ${CMAKE_BINARY_DIR}/kiosk/built_in)
add_custom_command(OUTPUT ${built_in}.fspack
    COMMAND frustumscreen-artifact amphora --triangles 2000 -o ${built_in}.glb
    COMMAND frustumscreen-bake ${built_in}.glb -o ${built_in}.fspack --prop cube --size 256 --no-relief --title Amphora --language en
    DEPENDS frustumscreen-artifact frustumscreen-bake
    BYPRODUCTS ${built_in}.glb
    COMMENT "Baking the built-in artifact" VERBATIM)
add_custom_target(frustumscreen-built-in ALL DEPENDS ${built_in}.fspack)
install(FILES ${built_in}.fspack DESTINATION /usr/share/frustumscreen COMPONENT base EXCLUDE_FROM_ALL)

# The shipped settings, with the paths of the packs on a kiosk. A museum's own settings are not overwritten.
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/config/kiosk.toml)
file(READ ${CMAKE_SOURCE_DIR}/config/kiosk.toml kiosk_settings)
string(REPLACE "../out/packs/" "/var/lib/frustumscreen/packs/" kiosk_settings "${kiosk_settings}")
string(REPLACE "../out/words.fswords" "/var/lib/frustumscreen/words.fswords" kiosk_settings "${kiosk_settings}")
file(WRITE ${CMAKE_BINARY_DIR}/kiosk/kiosk.toml "${kiosk_settings}")
install(FILES ${CMAKE_BINARY_DIR}/kiosk/kiosk.toml DESTINATION /usr/share/frustumscreen
    COMPONENT base EXCLUDE_FROM_ALL)
install(CODE "
    # file(INSTALL) itself puts DESTDIR before the destination.
    if(NOT EXISTS \"\$ENV{DESTDIR}/etc/frustumscreen/kiosk.toml\")
        file(INSTALL \"${CMAKE_BINARY_DIR}/kiosk/kiosk.toml\" DESTINATION /etc/frustumscreen)
    endif()" COMPONENT kiosk EXCLUDE_FROM_ALL)
