#include "app/counts/counts_folder.h"

#include "firmware_host/base/calendar_day.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/folder_entries.h"

#include <fmt/format.h>

#include <map>

namespace frustumscreen::counts {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view undated_name = "undated.json";
constexpr std::string_view day_form = "2026-11-27";
constexpr std::string_view ending = ".json";
constexpr std::uintmax_t max_bytes = 1U << 20U;
constexpr int max_put_aside = 100; ///< of one day

/// The day at the beginning of a file's name.
std::optional<std::chrono::sys_days> day_of(const fs::path& file) {
    return parse_day(file.filename().string().substr(0, day_form.size()));
}

bool is_counts(const fs::path& file) {
    const std::string name = file.filename().string();
    return name == undated_name || (day_of(file) && name.substr(day_form.size()) == ending);
}

Result<DayCounts> read_day(const fs::path& file) {
    TRY(const Bytes bytes, read_file(file, max_bytes));
    Result<DayCounts> counts = at(file.string(), parse_day_counts(as_text(bytes)));
    if (counts && file.filename() != undated_name && counts->day != day_of(file)) {
        return bad_input("counts.other_day", "{}: its numbers are not of the day in its name", file.string());
    }
    return counts;
}

/// Returns the file's new name.
Result<fs::path> put_aside(const fs::path& file) {
    for (int k = 1; k <= max_put_aside; ++k) {
        fs::path aside = file;
        aside += k == 1 ? ".bad" : fmt::format(".{}.bad", k);
        std::error_code failed;
        if (fs::exists(aside, failed)) {
            continue;
        }
        fs::rename(file, aside, failed);
        if (!failed) {
            return aside;
        }
        return bad_input("counts.not_put_aside", "{}: it is damaged, and cannot be renamed: {}",
                         file.string(), failed.message());
    }
    return bad_input("counts.much_damage", "{}: it is damaged, and so were {} before it; look at the disk",
                     file.string(), max_put_aside);
}

} // namespace

fs::path file_of_day(const fs::path& folder, std::optional<std::chrono::sys_days> day) {
    return folder / (day ? text_of_day(*day) + std::string(ending) : std::string(undated_name));
}

Result<OpenedDay> open_day(const fs::path& folder, std::optional<std::chrono::sys_days> day) {
    OpenedDay opened;
    opened.counts.day = day;
    const fs::path file = file_of_day(folder, day);
    std::error_code missing;
    if (!fs::exists(file, missing)) {
        return opened;
    }
    TRY_VOID(without_value(read_file(file, max_bytes))); // a file that cannot be read now may be undamaged
    Result<DayCounts> counts = read_day(file);
    if (counts) {
        opened.counts = *std::move(counts);
    } else {
        TRY(const fs::path aside, put_aside(file));
        opened.trouble = fmt::format("{}; it was renamed to {}, and the day's counts begin again",
                                     counts.error().message, aside.filename().string());
    }
    return opened;
}

Result<void> keep_day(const fs::path& folder, const DayCounts& counts) {
    return write_file(file_of_day(folder, counts.day), as_bytes(write_day_counts(counts)));
}

void drop_old_days(const fs::path& folder) {
    std::map<std::chrono::sys_days, std::vector<fs::path>> files;
    for (const fs::directory_entry& entry : entries_of(folder)) {
        const bool is_ours = is_counts(entry.path()) || entry.path().extension() == ".bad";
        if (const auto day = day_of(entry.path()); day && is_ours) {
            files[*day].push_back(entry.path());
        }
    }
    while (files.size() > max_days) {
        for (const fs::path& file : files.begin()->second) {
            std::error_code stays;
            fs::remove(file, stays);
        }
        files.erase(files.begin());
    }
}

Result<ReadCounts> read_counts(const fs::path& folder) {
    ReadCounts read;
    std::vector<fs::path> files;
    const FolderEntries listed = entries_of(folder);
    if (listed.failed) {
        return bad_input("counts.no_folder", "{}: no counts can be read there: {}", folder.string(),
                         listed.failed.message());
    }
    for (const fs::directory_entry& entry : listed) {
        if (is_counts(entry.path())) {
            files.push_back(entry.path());
        } else if (entry.path().extension() == ".bad") {
            read.trouble.push_back(entry.path().string() + ": it was damaged, and was put aside");
        }
    }
    for (const fs::path& file : files) {
        Result<DayCounts> counts = read_day(file);
        if (!counts) {
            read.trouble.push_back(counts.error().message);
        } else if (counts->day) {
            read.days.push_back(*std::move(counts));
        } else {
            read.undated = *std::move(counts);
        }
    }
    return read;
}

} // namespace frustumscreen::counts
