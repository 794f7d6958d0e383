#include "firmware_host/base/output_file.h"

#include "firmware_host/base/file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace frustumscreen {

namespace {

namespace fs = std::filesystem;

/// Creates an empty file and removes it: missing rights are not the only obstacle.
Result<void> try_to_write_in(const fs::path& folder) {
    const std::string probe = (folder / (".frustumscreen" + std::to_string(::getpid()))).string();
    const int descriptor = ::open(probe.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (descriptor < 0) {
        return bad_input("output.folder", folder.string() + ": nothing can be written into this folder: " +
                                              std::strerror(errno) +
                                              "; choose another folder, or get the right to write there");
    }
    ::close(descriptor);
    ::unlink(probe.c_str());
    return {};
}

Result<void> check_space(const fs::path& folder, std::uintmax_t bytes) {
    std::error_code failed;
    const fs::space_info space = fs::space(folder, failed);
    if (failed || space.available >= bytes) {
        return {};
    }
    constexpr std::uintmax_t megabyte = 1'000'000;
    return bad_input("output.no_room", folder.string() + ": " + std::to_string(space.available / megabyte) +
                                           " MB are left there, and up to " +
                                           std::to_string(bytes / megabyte + 1) +
                                           " MB may be needed; make room, or choose another folder");
}

} // namespace

Result<void> check_output_place(const fs::path& output, std::uintmax_t bytes) {
    std::error_code ignored;
    if (fs::exists(output, ignored) && !fs::is_regular_file(output, ignored)) {
        return bad_input("output.not_regular",
                         output.string() +
                             ": this is not a regular file; choose another name for the output");
    }
    const fs::path folder = output.has_parent_path() ? output.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, ignored)) {
        return bad_input("output.no_folder",
                         output.string() + ": there is no folder " + folder.string() + "; make it first");
    }
    TRY_VOID(try_to_write_in(folder));
    clear_partial_files(output); // before the free space is measured
    return check_space(folder, bytes);
}

Result<void> check_output_is_no_input(const fs::path& output, std::span<const fs::path> inputs) {
    for (const fs::path& input : inputs) {
        std::error_code ignored; // if one of them does not exist, they differ
        if (fs::equivalent(output, input, ignored)) {
            return bad_input("output.is_input", output.string() + ": this would replace the input " +
                                                    input.string() + "; choose another name for the output");
        }
    }
    return {};
}

} // namespace frustumscreen
