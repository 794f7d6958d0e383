# Headers that most files include, parsed once for the rooms and programs and once for the tests: half of the
# processor time of a build. Every file names what it needs all the same: the presets debug and fuzz build without them.
function(frustumscreen_precompile name header)
    file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/${name}.cpp CONTENT "") # keeps its time where it is there
    add_library(${name} OBJECT ${CMAKE_BINARY_DIR}/${name}.cpp)
    target_link_libraries(${name} PRIVATE frustumscreen_options fmt::fmt glm::glm tl::expected ${ARGN})
    target_precompile_headers(${name} PRIVATE <cmake/${header}>) # without this clone's folder, so that ccache finds it in another
endfunction()

# frustumscreen_use_precompiled(<target> house|tests)
function(frustumscreen_use_precompiled target which)
    if(FRUSTUMSCREEN_PRECOMPILED)
        target_precompile_headers(${target} REUSE_FROM precompiled_${which})
        target_link_libraries(${target} PRIVATE fmt::fmt) # its definitions are those that the headers were parsed with
        # GCC 12 warns of its own string library (PR 105329) where it comes out of a precompiled header; the presets without
        # one still look.
        target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds -Wno-restrict
            -Wno-stringop-overflow -Wno-stringop-overread>)
    endif()
endfunction()

if(FRUSTUMSCREEN_PRECOMPILED)
    frustumscreen_precompile(precompiled_house precompiled_house.h)
    if(BUILD_TESTING)
        frustumscreen_precompile(precompiled_tests precompiled_tests.h GTest::gtest)
        target_compile_options(precompiled_tests PRIVATE ${test_options})
    endif()
endif()
