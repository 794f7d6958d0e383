#include "tests/folders.h"

namespace frustumscreen {

// Constants of other files are made from these before main: each is there when it is first asked for.

const std::string& source_dir() {
    static const std::string folder = FRUSTUMSCREEN_SOURCE_DIR;
    return folder;
}

const std::string& build_dir() {
    static const std::string folder = FRUSTUMSCREEN_BUILD_DIR;
    return folder;
}

const std::string& bin_dir() {
    static const std::string folder = FRUSTUMSCREEN_BIN_DIR;
    return folder;
}

const std::string& shared_dir() {
    static const std::string folder = FRUSTUMSCREEN_SHARED_DIR;
    return folder;
}

} // namespace frustumscreen
