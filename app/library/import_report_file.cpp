#include "app/library/import_report_file.h"

#include "app/library/import_end.h"
#include "firmware_host/base/file.h"

#include <sys/stat.h>

#include <chrono>
#include <ctime>
#include <thread>

namespace frustumscreen::library {

std::optional<ImportReport> read_import_report(const std::filesystem::path& file) {
    constexpr std::uintmax_t max_report_bytes = 8U << 20U;
    const Result<Bytes> bytes = read_file(file, max_report_bytes);
    Result<ImportReport> report =
        bytes ? parse_import_report(as_text(*bytes)) : tl::unexpected<Error>(bytes.error());
    return report ? std::optional(*std::move(report)) : std::nullopt;
}

void wait_for_readers(const std::filesystem::path& file, std::string_view import_id, double stands_s) {
    struct stat status {};
    if (stands_s <= 0 || ::stat(file.c_str(), &status) != 0) {
        return;
    }
    timespec now{};
    ::clock_gettime(CLOCK_REALTIME, &now);
    const Nanoseconds age = std::chrono::seconds(now.tv_sec - status.st_mtim.tv_sec) +
                            std::chrono::nanoseconds(now.tv_nsec - status.st_mtim.tv_nsec);
    const auto stands = std::chrono::duration_cast<Nanoseconds>(std::chrono::duration<double>(stands_s));
    std::this_thread::sleep_for(delay_before_first_report(read_import_report(file), import_id, age, stands));
}

} // namespace frustumscreen::library
