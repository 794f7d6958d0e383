#include "firmware_host/panel/key_lines.h"

#include "firmware_host/base/folder_entries.h"
#include "firmware_host/panel/key_levels.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <libevdev/libevdev.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>

namespace frustumscreen::panel {

namespace {

namespace fs = std::filesystem;
constexpr const char* folder = "/dev/input";
using KeyBits = std::array<std::byte, KEY_MAX / 8 + 1>;

tl::unexpected<Error> lost(const std::string& name, int error) {
    const auto reason = [error]() -> std::string {
        switch (error) {
        case EACCES:
        case EPERM:
            return "no permission; put the exhibit's user into the group input";
        case ENOENT:
        case ENODEV:
        case ENXIO:
            return "it is not there; is it plugged in?";
        case EBUSY:
            return "another program has exclusive use of it; end that program, or name another keyboard";
        default:
            return std::strerror(error);
        }
    };
    return fail(ErrorKind::DeviceLost, "panel.keyboard_lost", "keyboard {}: {}", name, reason());
}

class File {
public:
    explicit File(int file) : file_(file) {}
    ~File() {
        if (file_ >= 0) {
            ::close(file_);
        }
    }
    File(File&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
    File& operator=(File&& other) noexcept {
        std::swap(file_, other.file_);
        return *this;
    }
    [[nodiscard]] int get() const { return file_; }

private:
    int file_;
};

File open_device(const fs::path& path) {
    return File(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
}

/// Opens the first device in /dev/input with this name; otherwise returns an error number with the reason.
tl::expected<File, int> find(const std::string& name) {
    int trouble = ENOENT;
    for (const fs::directory_entry& entry : entries_of(folder)) {
        if (entry.path().filename().string().rfind("event", 0) != 0) {
            continue;
        }
        File file = open_device(entry.path());
        if (file.get() < 0) {
            trouble = errno == EACCES ? EACCES : trouble;
            continue;
        }
        std::array<char, 256> said{};
        if (::ioctl(file.get(), EVIOCGNAME(said.size() - 1), said.data()) >= 0 && name == said.data()) {
            return file;
        }
    }
    return tl::unexpected(trouble);
}

class KeyLines final : public ButtonLines {
public:
    KeyLines(File file, std::string name, std::vector<std::uint16_t> codes)
        : file_(std::move(file)), name_(std::move(name)), levels_(std::move(codes)) {
        ask();
    }

    [[nodiscard]] Result<void> read(std::span<bool> down) override {
        for (std::size_t k = 0; k < down.size(); ++k) {
            down[k] = levels_.down(k);
        }
        return {};
    }

    [[nodiscard]] Result<void> wait(Nanoseconds timeout) override {
        pollfd waiting{file_.get(), POLLIN, 0};
        const auto ms = std::chrono::ceil<std::chrono::milliseconds>(timeout).count();
        const int found = ::poll(&waiting, 1, static_cast<int>(ms));
        if (found < 0 && errno != EINTR) {
            return lost(name_, errno);
        }
        if (found <= 0) {
            return {};
        }
        std::array<std::byte, 64 * sizeof(input_event)> bytes{};
        const ssize_t size = ::read(file_.get(), bytes.data(), bytes.size());
        if (size == 0 || (size < 0 && errno != EAGAIN && errno != EINTR)) {
            return lost(name_, size == 0 ? ENODEV : errno);
        }
        if (size > 0 && levels_.take(std::span(bytes).first(static_cast<std::size_t>(size)))) {
            ask();
        }
        return {};
    }

private:
    void ask() {
        KeyBits keys{};
        if (::ioctl(file_.get(), EVIOCGKEY(keys.size()), keys.data()) >= 0) {
            levels_.set(keys);
        }
    }

    File file_;
    std::string name_;
    KeyLevels levels_;
};

} // namespace

Result<std::unique_ptr<ButtonLines>> open_key_lines(const KeyRequest& request) {
    const bool is_path = request.device.find('/') != std::string::npos;
    File file = is_path ? open_device(request.device) : File(-1);
    if (is_path && file.get() < 0) {
        return lost(request.device, errno);
    }
    if (!is_path) {
        tl::expected<File, int> found = find(request.device);
        if (!found) {
            return lost(request.device, found.error());
        }
        file = std::move(*found);
    }
    KeyBits keys{};
    if (::ioctl(file.get(), EVIOCGBIT(EV_KEY, keys.size()), keys.data()) < 0) {
        return fail(ErrorKind::DeviceLost, "panel.no_event_device",
                    "keyboard {}: it is not an event device; name one of those in {}", request.device,
                    folder);
    }
    KeyLevels there(request.codes);
    there.set(keys); // the same bits, but for existing keys
    for (std::size_t k = 0; k < request.codes.size(); ++k) {
        if (!there.down(k)) {
            return fail(ErrorKind::DeviceLost, "panel.no_key",
                        "keyboard {}: it has no key {}; evtest shows the keys that it has", request.device,
                        libevdev_event_code_get_name(EV_KEY, request.codes[k]));
        }
    }
    if (::ioctl(file.get(), EVIOCGRAB, 1) < 0) { // grabs the keyboard until the file is closed
        return lost(request.device, errno);
    }
    return std::make_unique<KeyLines>(std::move(file), request.device, request.codes);
}

std::unique_ptr<ButtonLines> key_lines_over(int file, std::string name, std::vector<std::uint16_t> codes) {
    return std::make_unique<KeyLines>(File(file), std::move(name), std::move(codes));
}

Result<std::vector<std::uint16_t>> key_codes(std::span<const std::string> names) {
    std::vector<std::uint16_t> codes;
    for (const std::string& name : names) {
        const int code = libevdev_event_code_from_name(EV_KEY, name.c_str());
        if (code < 0) {
            return fail(ErrorKind::BadConfiguration, "panel.unknown_key",
                        "panel.keys: there is no key {}; allowed are names such as KEY_LEFT, "
                        "KEY_SPACE, KEY_A; evtest shows them",
                        name);
        }
        codes.push_back(static_cast<std::uint16_t>(code));
    }
    return codes;
}

} // namespace frustumscreen::panel
