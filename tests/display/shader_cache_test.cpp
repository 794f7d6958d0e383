// The cache of compiled shaders: Mesa itself, on a disk with free space and on a full one.

#include "firmware_host/display/shader_cache.h"
#include "firmware_host/display/surfaceless_display.h"
#include "tests/base/temporary_folder.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

namespace frustumscreen::display {
namespace {

namespace fs = std::filesystem;

constexpr int no_namespace = 77;

/// Draws once, like the exhibit's first frame; Mesa compiles and caches shaders for it.
bool draws() {
    const auto display = SurfacelessDisplay::create(64, 64);
    return display.has_value();
}

/// Runs in a child process, because Mesa reads the environment once. Returns its exit status, or minus the
/// signal that ended it.
template <typename Body> int in_a_process(const Body& body) {
    const pid_t child = ::fork();
    if (child == 0) {
        ::_exit(body());
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
}

class ShaderCache : public WithTemporaryFolder {};

/// Mounts a full disk of 8 KiB over `folder`, for this process alone.
bool mount_full_disk(const fs::path& folder) {
    if (::unshare(::geteuid() == 0 ? CLONE_NEWNS : CLONE_NEWNS | CLONE_NEWUSER) != 0 ||
        ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
        ::mount("full", folder.c_str(), "tmpfs", 0, "size=8k") != 0) {
        return false;
    }
    std::ofstream(folder / "full") << std::string(8192, 'x') << std::flush;
    return true;
}

TEST_F(ShaderCache, AllocatesTheWholeIndexInTheSizeThatMesaExpects) {
    const fs::path index = folder / "cache/mesa_shader_cache/index";
    const int ended = in_a_process([&] {
        if (!keep_shaders_in(folder / "cache")) {
            return 1;
        }
        struct stat before {};
        ::stat(index.c_str(), &before);
        return draws() && before.st_blocks * 512 >= before.st_size ? 0 : 2;
    });
    ASSERT_EQ(ended, 0);
    struct stat after {};
    ASSERT_EQ(::stat(index.c_str(), &after), 0);
    EXPECT_EQ(after.st_size, 1310728)
        << "Mesa has an index of another size: firmware_host/display/shader_cache.cpp";
}

TEST_F(ShaderCache, ReportsAFullDiskAndMesaStillDraws) {
    const int ended = in_a_process([&] {
        if (!mount_full_disk(folder)) {
            return no_namespace;
        }
        const Result<void> kept = keep_shaders_in(folder);
        const std::string expected =
            folder.string() +
            ": compiled shaders cannot be kept there: No space left on device; each start takes longer";
        return kept ? 1 : kept.error().message != expected ? 2 : draws() ? 0 : 3;
    });
    if (ended == no_namespace) {
        GTEST_SKIP() << "this system lets only root mount a disk";
    }
    EXPECT_EQ(ended, 0);
}

} // namespace
} // namespace frustumscreen::display
