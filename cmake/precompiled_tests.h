/// The headers that most tests include; see precompiled.cmake.
#include "precompiled_house.h"

#include <gtest/gtest.h>
