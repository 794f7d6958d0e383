#include "firmware_host/base/descriptor.h"
#include "firmware_host/base/folder_entries.h"
#include "firmware_host/camera/v4l2_device.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <filesystem>
#include <string_view>

namespace frustumscreen::camera {

namespace {

namespace fs = std::filesystem;
constexpr std::string_view prefix = "/dev/video";

class V4l2File final : public V4l2Device {
public:
    explicit V4l2File(int file) : file_(file) {}
    V4l2File(const V4l2File&) = delete;
    V4l2File& operator=(const V4l2File&) = delete;
    ~V4l2File() override {
        for (const auto& [address, size] : mapped_) {
            ::munmap(address, size);
        }
    }

    [[nodiscard]] int control(unsigned long request, void* argument) override {
        int status = 0;
        do {
            status = ::ioctl(file_.number(), request, argument);
        } while (status < 0 && errno == EINTR);
        return status < 0 ? errno : 0;
    }
    [[nodiscard]] int wait(Nanoseconds timeout) override {
        pollfd waiting{file_.number(), POLLIN, 0};
        const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(timeout).count();
        const int ready = ::poll(&waiting, 1, static_cast<int>(ms));
        if (ready < 0) {
            return errno == EINTR ? EAGAIN : errno;
        }
        return ready == 0 ? EAGAIN : 0; // the next ioctl reports an error
    }
    [[nodiscard]] tl::expected<std::span<const std::byte>, int> map(std::size_t offset,
                                                                    std::size_t size) override {
        void* const address =
            ::mmap(nullptr, size, PROT_READ, MAP_SHARED, file_.number(), static_cast<off_t>(offset));
        if (address == MAP_FAILED) {
            return tl::unexpected(errno);
        }
        mapped_.push_back({address, size});
        return std::span(static_cast<const std::byte*>(address), size);
    }

private:
    struct Mapped {
        void* address;
        std::size_t size;
    };
    Descriptor file_; ///< closed after the buffers are unmapped
    std::vector<Mapped> mapped_;
};

class V4l2Files final : public V4l2Devices {
public:
    [[nodiscard]] std::vector<std::string> list() override {
        std::vector<std::pair<int, std::string>> found;
        for (const fs::directory_entry& entry : entries_of("/dev")) {
            const std::string& path = entry.path().native();
            if (path.rfind(prefix, 0) != 0) {
                continue;
            }
            int number = 0;
            const char* const last = path.data() + path.size();
            const auto [stop, wrong] = std::from_chars(path.data() + prefix.size(), last, number);
            if (wrong == std::errc() && stop == last) {
                found.emplace_back(number, path);
            }
        }
        std::sort(found.begin(), found.end());
        std::vector<std::string> paths;
        for (auto& [number, path] : found) {
            paths.push_back(std::move(path));
        }
        return paths;
    }
    [[nodiscard]] tl::expected<std::unique_ptr<V4l2Device>, int> open(const std::string& path) override {
        const int file = ::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
        if (file < 0) {
            return tl::unexpected(errno);
        }
        return std::make_unique<V4l2File>(file);
    }
};

} // namespace

std::unique_ptr<V4l2Devices> kernel_v4l2_devices() {
    return std::make_unique<V4l2Files>();
}

} // namespace frustumscreen::camera
