# Headers that most files include, parsed once for the rooms and programs and once for the tests; this saves half of the
# processor time of a build. Every file still includes what it needs: the presets debug and fuzz build without precompiled headers.
function(frustumscreen_precompile name header)
    file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/${name}.cpp CONTENT "") # an unchanged file keeps its modification time
    add_library(${name} OBJECT ${CMAKE_BINARY_DIR}/${name}.cpp)
    target_link_libraries(${name} PRIVATE frustumscreen_options fmt::fmt glm::glm tl::expected ${ARGN})
    target_precompile_headers(${name} PRIVATE <cmake/${header}>) # a relative path, so that ccache also hits in another clone
endfunction()

# frustumscreen_use_precompiled(<target> house|tests)
function(frustumscreen_use_precompiled target which)
    if(FRUSTUMSCREEN_PRECOMPILED)
        target_precompile_headers(${target} REUSE_FROM precompiled_${which})
        target_link_libraries(${target} PRIVATE fmt::fmt) # the same definitions as for the precompiled headers
        # GCC 12 gives false warnings about its own string library (PR 105329) if that comes from a precompiled header. The presets
        # without precompiled headers keep these warnings on.
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
