/// What most programs include; see precompiled.cmake.
#include "precompiled_house.h"

#include <CLI/CLI.hpp>
