#include "app/programs/frustumscreen/staff_service.h"

#include "firmware_host/base/printable.h"

#include <fmt/format.h>

namespace frustumscreen::programs {

namespace {

constexpr std::string_view screenshot_question = "screenshot";
constexpr std::size_t max_picture_bytes = 64U << 20;
constexpr Nanoseconds longest_wait = std::chrono::seconds(10);

} // namespace

std::unique_ptr<service::StaffSocket> open_staff_socket(const std::filesystem::path& path,
                                                        show::Screenshot& screenshot,
                                                        const service::Journal& journal) {
    if (path.empty()) {
        return nullptr;
    }
    Result<std::unique_ptr<service::StaffSocket>> socket = service::StaffSocket::open(
        path, [&screenshot](std::string_view question, const std::stop_token& stop) -> Result<Bytes> {
            if (question != screenshot_question) {
                return bad_input("staff.no_question", "unknown question '{}'; ask '{}'",
                                 printable(question, 64), screenshot_question);
            }
            TRY(const image::Image8* const picture, screenshot.take(stop));
            return image::encode_png(*picture);
        });
    if (!socket) {
        journal.note(service::LogPriority::Warning, socket.error().message, {{"DEVICE", "staff"}});
        return nullptr;
    }
    return std::move(*socket);
}

Result<Bytes> ask_for_screenshot(const std::filesystem::path& path) {
    return service::ask_staff_socket(path, screenshot_question, max_picture_bytes, longest_wait);
}

} // namespace frustumscreen::programs
