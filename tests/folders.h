/// The folders of the source, of the build and of the shared test data.
///
/// Shape   absolute paths, without a slash at their end.
/// Source  CMake. folders.cpp alone is compiled with them: every other file has the same command line in each clone, so that
///         ccache finds what another clone compiled.
#pragma once

#include <string>

namespace frustumscreen {

/// The root of the repository.
[[nodiscard]] const std::string& source_dir();
/// The folder that this build is made in.
[[nodiscard]] const std::string& build_dir();
/// The programs of this build.
[[nodiscard]] const std::string& bin_dir();
/// Models and recordings that are not part of the repository; it may be missing.
[[nodiscard]] const std::string& shared_dir();

} // namespace frustumscreen
