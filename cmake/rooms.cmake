# One static library for each room of the house; docs/rooms.md has the map.
#
#   frustumscreen_room(<room> SOURCES ... [APART <source>...] [USES <room>...] [LIBRARIES <target>...])
#
# SOURCES are compiled eight at a time. APART are compiled alone:
#   - a source whose unnamed namespace has a name of another source;
#   - the sources of a room that some programs need in part, because a program links whole object files, and the shared libraries they call;
#   - sources that GCC compiles faster alone, such as those with Eigen's templates.
# USES are the rooms that this room may include; tests/layers checks every #include against it.
add_library(frustumscreen_options INTERFACE)
target_compile_features(frustumscreen_options INTERFACE cxx_std_20)
target_include_directories(frustumscreen_options INTERFACE ${CMAKE_SOURCE_DIR})
target_compile_definitions(frustumscreen_options INTERFACE GLM_FORCE_RADIANS GLM_ENABLE_EXPERIMENTAL)
set(warnings -Wall -Wextra -Wpedantic -Wconversion)
if(NOT FRUSTUMSCREEN_ASAN AND NOT FRUSTUMSCREEN_TSAN) # the sanitizers' own code causes false warnings
    list(APPEND warnings -Werror)
endif()
target_compile_options(frustumscreen_options INTERFACE ${warnings} -ffp-contract=off
    -ffunction-sections -fdata-sections # the link leaves out unused code, most of it of the JSON library
    -ffile-prefix-map=${CMAKE_SOURCE_DIR}/=) # so that a program's bytes do not depend on the build folder
target_link_options(frustumscreen_options INTERFACE -Wl,--gc-sections)
# For loops over pixels and triangles. GCC 12 itself crashes at -O3 with the sanitizers and with gcov.
if(NOT FRUSTUMSCREEN_ASAN AND NOT FRUSTUMSCREEN_TSAN AND NOT CMAKE_CXX_FLAGS MATCHES "--coverage")
    set(FRUSTUMSCREEN_LOOPS -O3)
endif()
if(FRUSTUMSCREEN_ASAN)
    target_compile_options(frustumscreen_options INTERFACE
        -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
    target_link_options(frustumscreen_options INTERFACE -fsanitize=address,undefined)
endif()
if(FRUSTUMSCREEN_TSAN)
    target_compile_options(frustumscreen_options INTERFACE -fsanitize=thread)
    target_link_options(frustumscreen_options INTERFACE -fsanitize=thread)
endif()
if(FRUSTUMSCREEN_FUZZ)
    target_compile_options(frustumscreen_options INTERFACE -fsanitize=fuzzer-no-link)
endif()

# Tests run once or twice for each build, so -O2 would cost more compile time than it saves run time.
set(test_options $<$<CONFIG:RelWithDebInfo>:-O1>)
set(rooms_alone_are_checked OFF)
if(FRUSTUMSCREEN_ASAN AND NOT FRUSTUMSCREEN_FUZZ)
    # Only the rooms are compiled with the undefined-behaviour checks. With them, the tests and the programs' options take twice
    # the time to compile, or more.
    set(rooms_alone_are_checked ON)
    set(test_options -O0 -fno-sanitize=undefined)
endif()
# GCC takes a type in the unnamed namespace of an included source for a type of a header, and warns.
set(unity_options $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
if(FRUSTUMSCREEN_UNITY)
    list(APPEND test_options ${unity_options})
endif()
include(cmake/precompiled.cmake)

# Sets `sources` to files that include up to NUMBER sources each: reading the headers takes longer than compiling most sources. A source
# with options of its own stays alone; its set_source_files_properties comes before this call. The files contain no absolute path, so that
# ccache finds them in another clone.
function(frustumscreen_together target number)
    if(NOT FRUSTUMSCREEN_UNITY)
        set(sources ${ARGN} PARENT_SCOPE)
        return()
    endif()
    file(RELATIVE_PATH folder ${CMAKE_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
    set(together "")
    set(count 0)
    foreach(source IN LISTS ARGN)
        get_source_file_property(options ${source} COMPILE_OPTIONS)
        if(NOT options STREQUAL NOTFOUND OR IS_ABSOLUTE ${source}) # absolute: generated, or of another folder
            list(APPEND together ${source})
        else()
            math(EXPR file "${count} / ${number}")
            string(APPEND includes_${file} "#include \"${folder}/${source}\"\n")
            math(EXPR count "${count} + 1")
        endif()
    endforeach()
    set(file 0)
    while(DEFINED includes_${file})
        set(path ${CMAKE_BINARY_DIR}/together/${target}_${file}.cpp)
        file(CONFIGURE OUTPUT ${path} CONTENT "${includes_${file}}" @ONLY) # an unchanged file keeps its modification time
        list(APPEND together ${path})
        math(EXPR file "${file} + 1")
    endwhile()
    set(sources ${together} PARENT_SCOPE)
endfunction()

# For the files that frustumscreen_together has made.
function(frustumscreen_no_linkage_warning)
    foreach(source IN LISTS ARGN)
        if(source MATCHES "^${CMAKE_BINARY_DIR}/together/")
            set_source_files_properties(${source} PROPERTIES COMPILE_OPTIONS "${unity_options}")
        endif()
    endforeach()
endfunction()

function(frustumscreen_room room)
    cmake_parse_arguments(ROOM "" "" "SOURCES;APART;USES;LIBRARIES" ${ARGN})
    frustumscreen_together(${room} 8 ${ROOM_SOURCES})
    frustumscreen_no_linkage_warning(${sources})
    add_library(${room} STATIC ${sources} ${ROOM_APART})
    target_link_libraries(${room} PUBLIC frustumscreen_options ${ROOM_USES} ${ROOM_LIBRARIES})
    frustumscreen_use_precompiled(${room} house)
    set_property(GLOBAL APPEND PROPERTY FRUSTUMSCREEN_LAYERS "${room}: ${ROOM_USES}")
    set_property(GLOBAL APPEND PROPERTY FRUSTUMSCREEN_LAYER_FOLDERS
        "${room}=${CMAKE_CURRENT_SOURCE_DIR}")
endfunction()

add_custom_target(programs) # all of them, without the tests
function(frustumscreen_program name)
    cmake_parse_arguments(PROGRAM "" "" "SOURCES;APART;USES" ${ARGN})
    frustumscreen_together(${name} 8 ${PROGRAM_SOURCES})
    frustumscreen_no_linkage_warning(${sources})
    add_executable(${name} ${sources} ${PROGRAM_APART})
    target_link_libraries(${name} PRIVATE frustumscreen_options ${PROGRAM_USES})
    if(rooms_alone_are_checked)
        target_compile_options(${name} PRIVATE ${test_options})
    else()
        frustumscreen_use_precompiled(${name} house)
    endif()
    add_dependencies(programs ${name})
    set_property(GLOBAL APPEND PROPERTY FRUSTUMSCREEN_LAYERS "${name}: ${PROGRAM_USES}")
    set_property(GLOBAL APPEND PROPERTY FRUSTUMSCREEN_LAYER_FOLDERS "${name}=${CMAKE_CURRENT_SOURCE_DIR}")
endfunction()

# The tests of code that reads bytes from outside or shares memory between threads. They run under the sanitizers for every change.
add_custom_target(outside)
# The subset that tests code that shares memory between threads. They run under the thread sanitizer.
add_custom_target(threads)

# A test's command begins with ${run_test} and the test's name.
set(run_test ${CMAKE_SOURCE_DIR}/tests/house/run_test.sh)

# mold links a test in a third of the time; the programs are linked by the system's own linker.
find_program(MOLD mold)
set(test_linker $<$<BOOL:${MOLD}>:-fuse-ld=mold;-Wl,--no-fork>)

# The folders that the tests read. Only this library has these paths on its command line, so that ccache finds the tests' objects from
# another clone.
if(BUILD_TESTING)
    add_library(test_folders STATIC ${CMAKE_SOURCE_DIR}/tests/folders.cpp)
    target_link_libraries(test_folders PRIVATE frustumscreen_options)
    target_compile_definitions(test_folders PRIVATE
        FRUSTUMSCREEN_SOURCE_DIR="${CMAKE_SOURCE_DIR}"
        FRUSTUMSCREEN_BUILD_DIR="${CMAKE_BINARY_DIR}"
        FRUSTUMSCREEN_BIN_DIR="${CMAKE_RUNTIME_OUTPUT_DIRECTORY}"
        FRUSTUMSCREEN_SHARED_DIR="${CMAKE_SOURCE_DIR}/../shared")
endif()

# A GoogleTest program of one room; its working directory is its own build folder.
#   OUTSIDE, THREADS  it belongs to the target of this name, above
#   WAITS             it spends most of its time waiting for a device or another program
#   COST              for a long test, its approximate seconds: it begins early even if ctest has no times of earlier runs
#   APART             sources whose unnamed namespace has a name that another source of the test also has
#   COMPUTING         cases of a test with OUTSIDE or THREADS that compute for long on one thread, from input that the test itself makes.
#                     They check numbers and pictures, which a sanitizer does not, and take ten times as long under one; other cases run
#                     the same code there. So under a sanitizer they are a separate test without labels, NAME_computing, which
#                     `./test asan --all` and `./test tsan --all` run.
function(frustumscreen_test name)
    cmake_parse_arguments(TEST "OUTSIDE;THREADS;WAITS" "COST" "SOURCES;APART;USES;LABELS;COMPUTING" ${ARGN})
    if(TEST_OUTSIDE OR TEST_THREADS)
        list(APPEND TEST_LABELS outside)
        add_dependencies(outside ${name})
    endif()
    if(TEST_THREADS)
        list(APPEND TEST_LABELS threads)
        add_dependencies(threads ${name})
    endif()
    frustumscreen_together(${name} 12 ${TEST_SOURCES})
    add_executable(${name} ${sources} ${TEST_APART})
    target_link_libraries(${name} PRIVATE frustumscreen_options ${TEST_USES} test_folders GTest::gtest_main)
    target_compile_options(${name} PRIVATE ${test_options})
    frustumscreen_use_precompiled(${name} tests)
    set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
    target_link_options(${name} PRIVATE ${test_linker})
    set(cases)
    if(TEST_COMPUTING AND (FRUSTUMSCREEN_ASAN OR FRUSTUMSCREEN_TSAN))
        list(JOIN TEST_COMPUTING ":" computing)
        set(cases "--gtest_filter=-${computing}")
        add_test(NAME ${name}_computing COMMAND ${run_test} ${name}_computing $<TARGET_FILE:${name}> "--gtest_filter=${computing}")
        set_tests_properties(${name}_computing PROPERTIES PROCESSORS 2)
    endif()
    add_test(NAME ${name} COMMAND ${run_test} ${name} $<TARGET_FILE:${name}> ${cases})
    # ./test has five slots on two cores. A test that computes takes two slots, one that waits takes one: it runs beside two that compute.
    if(NOT TEST_WAITS)
        set_tests_properties(${name} PROPERTIES PROCESSORS 2)
    endif()
    if(TEST_COST)
        set_tests_properties(${name} PROPERTIES COST ${TEST_COST})
    endif()
    if(TEST_LABELS)
        set_tests_properties(${name} PROPERTIES LABELS "${TEST_LABELS}")
    endif()
endfunction()
