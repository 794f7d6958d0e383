/// libgbm's objects on the fake kernel.
#pragma once

#include "tests/display/fake_kernel.h"

extern "C" {
#include <gbm.h>
}

struct gbm_device {
    int file;
    std::string renderer; ///< its name in OpenGL; empty: the processor draws (kms_swrast)
};

struct gbm_bo {
    int file = -1;
    int width = 0, height = 0;
    std::uint32_t handle = 0;
};
