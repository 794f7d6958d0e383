#include "app/status/known_exhibit.h"

#include "app/pack/json/json_reader.h"
#include "app/status/status_fields.h"
#include "app/status/status_report.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/printable.h"
#include "firmware_host/base/this_boot.h"

#include <fmt/format.h>
#include <sys/utsname.h>

#include <algorithm>
#include <fstream>

namespace frustumscreen::status {

namespace {

constexpr std::uintmax_t max_status_bytes = 1U << 20;
constexpr std::uintmax_t max_ends_bytes = 16U << 20;
constexpr std::size_t max_depth = 16;

/// The stamp is the same in the exhibit's and its watchdog's status.
StatusStamp read_stamp(const nlohmann::json& document) {
    StatusReader fields(document);
    StatusStamp stamp;
    fields.field("monotonic_ns", stamp.monotonic);
    fields.field("boot_id", stamp.boot_id);
    return stamp;
}

} // namespace

std::string system_name() {
    std::string name;
    std::ifstream release("/etc/os-release");
    for (std::string line; std::getline(release, line);) {
        constexpr std::string_view key = "PRETTY_NAME=\"";
        if (line.starts_with(key) && line.ends_with('"')) {
            name = printable(std::string_view(line).substr(key.size(), line.size() - key.size() - 1));
        }
    }
    utsname kernel{};
    if (::uname(&kernel) == 0) {
        name += fmt::format("{}{} {}", name.empty() ? "" : ", ", kernel.sysname, kernel.release);
    }
    return name;
}

StatusClock status_clock(const std::filesystem::path& root) {
    StatusClock clock{monotonic_now(), boot_id(root)};
    // The files of this machine have times of the monotonic clock, which /proc/uptime is not.
    if (double up_s = 0.0; root != "/" && std::ifstream(root / "proc/uptime") >> up_s) {
        clock.now = MonotonicTime(std::chrono::round<Nanoseconds>(std::chrono::duration<double>(up_s)));
    }
    return clock;
}

StatusDocument parse_status(std::string_view json, const StatusClock& clock) {
    StatusDocument document;
    pack::Refusal refusal{{}, "the file"};
    nlohmann::json fields = pack::parse_json(refusal, json, max_depth);
    if (refusal.error || !fields.is_object()) {
        document.why = "this is not a status: " +
                       printable(refusal.error ? refusal.error->message : "no object { ... }", 200);
        return document;
    }
    document.fields = std::move(fields);
    const StatusStamp written = read_stamp(document.fields);
    const std::string_view boot = written.boot_id.view();
    document.other_boot = !boot.empty() && !clock.boot_id.empty() && boot != clock.boot_id;
    if (written.monotonic && !document.other_boot) {
        const double age_s = to_seconds(clock.now - *written.monotonic);
        if (age_s >= -0.1) { // the status may be written just after the clock was read
            document.age_s = std::max(age_s, 0.0);
        }
    }
    return document;
}

StatusDocument read_status(const std::filesystem::path& file, const StatusClock& clock) {
    const Result<Bytes> bytes = read_file(file, max_status_bytes);
    if (!bytes) {
        StatusDocument document;
        document.why = printable(bytes.error().message, 300);
        return document;
    }
    StatusDocument document = parse_status(as_text(*bytes), clock);
    if (!document.why.empty()) {
        document.why = printable(file.string(), 200) + ": " + document.why;
    }
    return document;
}

void renew_environment(Environment& known, const StatusPlaces& places, const StatusClock& clock) {
    known.image = read_system_image(places.boot_folder);
    known.watchdog = read_status(places.watchdog_file, clock);
    known.monotonic_s = to_seconds(clock.now.time_since_epoch());
    if (known.system.empty()) {
        known.system = system_name();
        known.crashes = watch::read_crashes(places.crash_folder); // a later crash ends this process
    }
    if (MachineState& machine = known.machine;
        !machine.seen || clock.now - *machine.seen >= between_looks_at_machine) {
        machine = {clock.now, watch::hottest_c(places.root), watch::disk_space(places.data_folder)};
    }
    const std::filesystem::path file = places.status_file.parent_path() / "ends";
    std::error_code missing;
    const std::uintmax_t bytes =
        std::filesystem::exists(file, missing) ? std::filesystem::file_size(file, missing) : 0;
    if (bytes == known.ends_bytes && known.ends_trouble.empty()) {
        return;
    }
    known.ends_bytes = bytes;
    known.ends = {};
    known.ends_trouble.clear();
    const Result<Bytes> text = read_file(file, max_ends_bytes);
    if (text) {
        known.ends = watch::parse_service_ends(as_text(*text));
    } else if (bytes > 0) {
        known.ends_trouble = printable(text.error().message, 300);
    }
}

KnownExhibit read_known_exhibit(const StatusPlaces& places, const StatusClock& clock) {
    KnownExhibit known{read_status(places.status_file, clock), {}};
    renew_environment(known.environment, places, clock);
    return known;
}

} // namespace frustumscreen::status
