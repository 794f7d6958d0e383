#include "app/programs/safe/show_safe_picture.h"

#include "app/programs/safe/safe_screen.h"
#include "firmware_host/base/descriptor.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/this_boot.h"
#include "firmware_host/base/time.h"
#include "firmware_host/service/service_manager.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <thread>

namespace frustumscreen::programs {

namespace {

constexpr Nanoseconds between_pictures = std::chrono::seconds(1);

/// Writes one line: the number of pictures shown, and CLOCK_MONOTONIC of the latest one in ns.
Result<void> say_alive(const std::filesystem::path& file, std::uint64_t shown) {
    const std::string line = fmt::format("{} {}\n", shown, monotonic_now().time_since_epoch().count());
    return file.empty() ? Result<void>() : renew_file(file, as_bytes(line));
}

/// Reports to the service manager, and changes also to the journal.
class Narrator {
public:
    void tell(std::string_view sentence) {
        const Sentence told(sentence);
        if (!(told == last_)) {
            last_ = told;
            fmt::print(stderr, "frustumscreen-safe: {}\n", told.view());
        }
        manager_.status(told);
    }
    void ready() { manager_.ready(); }
    void feed_watchdog() { manager_.feed_watchdog(); }

private:
    service::ServiceManager manager_;
    Sentence last_;
};

} // namespace

std::string read_reason(const std::filesystem::path& file) {
    std::array<char, 4096> bytes{};
    struct stat what {};
    const Descriptor opened(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
    if (opened.number() < 0 || ::fstat(opened.number(), &what) != 0 || !S_ISREG(what.st_mode)) {
        return {};
    }
    const ssize_t count = ::read(opened.number(), bytes.data(), bytes.size());
    return {bytes.data(), count > 0 ? static_cast<std::size_t>(count) : 0};
}

safe::EyeHalves read_halves(const std::filesystem::path& stereo) {
    const std::string text = stereo.empty() ? std::string() : read_reason(stereo);
    return safe::halves_of(std::string_view(text).substr(0, text.find_first_of(" \r\n")));
}

Result<void> show_safe_picture(const SafeArguments& arguments) {
    Narrator narrator;
    std::unique_ptr<SafeScreen> screen;
    std::uint64_t shown = 0;
    for (MonotonicTime next = monotonic_now();; next = std::max(next + between_pictures, monotonic_now())) {
        std::this_thread::sleep_until(next);
        if (screen == nullptr) {
            Result<std::unique_ptr<SafeScreen>> opened =
                SafeScreen::open(arguments.card, arguments.languages, read_halves(arguments.stereo));
            if (!opened) {
                narrator.tell(opened.error().message); // a card may appear, and another program may end
            } else {
                screen = *std::move(opened);
            }
        }
        bool fed = screen == nullptr;
        if (screen != nullptr) {
            TRY(const bool on, screen->show({read_reason(arguments.reason),
                                             std::chrono::floor<std::chrono::minutes>(since_boot())}));
            const Result<void> said = on ? say_alive(arguments.alive, ++shown) : Result<void>();
            narrator.tell(said ? screen->state() : said.error().message); // the picture continues in any case
            fed = on || !screen->lit(); // the watchdog must notice a lit projector that takes no pictures
        }
        narrator.ready();
        if (fed) {
            narrator.feed_watchdog();
        }
    }
}

} // namespace frustumscreen::programs
