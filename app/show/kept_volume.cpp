#include "app/show/kept_volume.h"

#include "firmware_host/base/file.h"

#include <fmt/format.h>

#include <cstdio>
#include <utility>

namespace frustumscreen::show {

namespace {

constexpr std::uintmax_t max_bytes = 64;

std::string line_of(int louder_db, double over_db) {
    return fmt::format("louder_db {} over {}\n", louder_db, over_db);
}

} // namespace

int read_kept_volume(const std::filesystem::path& file, double settings_gain_db) {
    std::error_code failed;
    if (file.empty() || !std::filesystem::exists(file, failed)) {
        return 0;
    }
    const Result<Bytes> bytes = read_file(file, max_bytes);
    int louder_db = 0;
    if (!bytes || std::sscanf(std::string(as_text(*bytes)).c_str(), "louder_db %4d over", &louder_db) != 1) {
        return 0;
    }
    return as_text(*bytes) == line_of(louder_db, settings_gain_db) ? louder_db : 0;
}

VolumeKeeper::VolumeKeeper(std::filesystem::path file, double settings_gain_db)
    : file_(std::move(file)), settings_gain_db_(settings_gain_db),
      kept_db_(read_kept_volume(file_, settings_gain_db)) {
    // A volume chosen over other settings must not return with them.
    std::error_code failed;
    if (kept_db_ == 0 && !file_.empty()) {
        std::filesystem::remove(file_, failed);
    }
}

void VolumeKeeper::note(int louder_db) {
    if (file_.empty() || std::exchange(kept_db_, louder_db) == louder_db) {
        return;
    }
    const std::string line = line_of(louder_db, settings_gain_db_);
    static_cast<void>(write_file(file_, std::as_bytes(std::span(line))));
}

} // namespace frustumscreen::show
