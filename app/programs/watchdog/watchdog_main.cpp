/// frustumscreen-watchdog: watches the exhibit from outside, and climbs the recovery ladder. No GL, no USB,
/// no packs, no settings; one thread. Its memory is locked, so a shortage of memory cannot stop it.
#include "app/programs/common/command_line.h"
#include "app/programs/common/guarded_main.h"
#include "app/programs/watchdog/fault_book.h"
#include "app/programs/watchdog/kiosk_view.h"
#include "app/programs/watchdog/memory_file.h"
#include "app/programs/watchdog/orders.h"
#include "app/programs/watchdog/watchdog_report.h"
#include "app/watch/judge.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/local_time.h"
#include "firmware_host/base/this_boot.h"
#include "firmware_host/base/version.h"
#include "firmware_host/service/journal.h"
#include "firmware_host/service/service_manager.h"
#include "firmware_host/service/stop_signals.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/mman.h>

#include <thread>

namespace frustumscreen::programs {
namespace {

constexpr Nanoseconds between_looks = std::chrono::seconds(1);

struct Arguments {
    std::filesystem::path run_folder = "/run/frustumscreen-watchdog";
    std::filesystem::path state_folder = "/var/lib/frustumscreen-watchdog";
    double start_timeout_s = 60.0;
    double seconds = 0.0; ///< 0: until it is stopped
    KioskPlaces places;
};

watch::Timeouts timeouts_of(const Arguments& arguments) {
    watch::Timeouts timeouts;
    timeouts.start =
        std::chrono::duration_cast<Nanoseconds>(std::chrono::duration<double>(arguments.start_timeout_s));
    return timeouts;
}

class Watchdog {
public:
    Watchdog(const Arguments& arguments, MonotonicTime now)
        : boot_id_(boot_id(arguments.places.root)), view_(arguments.places, boot_id_),
          judge_(timeouts_of(arguments), now),
          memory_(arguments.state_folder / "memory", watch::number_of_boot(boot_id_)),
          faults_(arguments.state_folder / "faults"), orders_(arguments.run_folder),
          report_file_(arguments.run_folder / "status.json"),
          ladder_(memory_.remembered(since_boot()), !memory_.is_of_this_boot()) {}

    /// The mode must be set before the exhibit starts.
    void begin() { complain_of(orders_.begin(ladder_.memory().mode)); }

    void look(MonotonicTime now) {
        const watch::Outcome outcome = view_.look(now, std::chrono::system_clock::now());
        const watch::Observation seen = judge_.look(now, ladder_.memory().mode, outcome);
        watch::Capabilities capabilities = view_.capabilities();
        capabilities.reboot = memory_.can_write_now(now);
        const watch::Awake awake = std::max(memory_.remembered(since_boot()).awake, ladder_.memory().awake);
        const bool was_in_episode = ladder_.memory().cause.has_value();
        const std::optional<watch::LadderAction> act = ladder_.look(awake, seen, capabilities);
        if (was_in_episode && !ladder_.memory().cause && seen.lit && !seen.trouble) {
            faults_.note_good();
        }
        trouble_since_ = seen.trouble ? trouble_since_.value_or(now) : std::optional<MonotonicTime>{};
        if (act) {
            take(*act, now);
        }
        memory_.keep(now, since_boot(), ladder_.memory(), false);
        faults_.keep(now, false);
        report(now, seen, outcome);
    }

private:
    void take(const watch::LadderAction& act, MonotonicTime now) {
        const std::string_view cause = watch::sentence_of(act.cause);
        faults_.enter({.at = utc_text(std::chrono::system_clock::now()),
                       .awake = ladder_.memory().awake,
                       .cause = act.cause,
                       .step = act.step,
                       .detail = view_.last_end(),
                       .helped = {}});
        const std::string why = act.cause == watch::Cause::KeepsEnding ? view_.why_it_ended() : std::string();
        const std::string reason =
            fmt::format("{}{}{}; {}", cause, why.empty() ? "" : ": ", why, watch::sentence_of(act.step));
        journal_.note(
            act.cause ? service::LogPriority::Warning : service::LogPriority::Notice, reason,
            {{"STEP", watch::word_of(act.step)}, {"CAUSE", act.cause ? watch::word_of(*act.cause) : ""}});
        if (act.step == watch::Step::Reboot) {
            faults_.keep(now, true);
            if (!memory_.keep(now, since_boot(), ladder_.memory(), true)) {
                journal_.note(service::LogPriority::Error,
                              "the reboot cannot be recorded, so the computer is not restarted");
                return;
            }
        }
        complain_of(orders_.give(act.step, ladder_.memory().mode, reason));
        judge_.step_taken(now);
    }

    void report(MonotonicTime now, const watch::Observation& seen, const watch::Outcome& outcome) {
        const WatchdogReport report{.now = now,
                                    .at = utc_text(std::chrono::system_clock::now()),
                                    .boot_id = boot_id_,
                                    .memory = ladder_.memory(),
                                    .seen = seen,
                                    .trouble_for = now - trouble_since_.value_or(now),
                                    .reboots_within_day = ladder_.reboots_within_day(),
                                    .failures = outcome.failures,
                                    .last_end = view_.last_end(),
                                    .notes = notes_of(outcome)};
        complain_of(renew_file(report_file_, as_bytes(watchdog_json(report, faults_.latest()))));
    }

    /// Reports each message once.
    void complain_of(const Result<void>& result) {
        if (!result && result.error().message != complaint_) {
            complaint_ = result.error().message;
            journal_.note(service::LogPriority::Error, complaint_);
        }
    }

    service::Journal journal_{"frustumscreen-watchdog"};
    std::string boot_id_;
    KioskView view_;
    watch::Judge judge_;
    MemoryFile memory_;
    FaultBook faults_;
    Orders orders_;
    std::filesystem::path report_file_;
    watch::Ladder ladder_;
    std::optional<MonotonicTime> trouble_since_;
    std::string complaint_;
};

int watch(const Arguments& arguments) {
    const service::StopSignals signals;
    const service::ServiceManager manager;
    const MonotonicTime begin = monotonic_now();
    Watchdog watchdog(arguments, begin);
    watchdog.begin();
    if (::mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) != 0) {
        fmt::print(stderr,
                   "frustumscreen-watchdog: its memory cannot be locked; raise LimitMEMLOCK= of its unit\n");
    }
    for (MonotonicTime next = begin; !signals.received();) {
        const MonotonicTime now = monotonic_now();
        if (arguments.seconds > 0.0 && to_seconds(now - begin) >= arguments.seconds) {
            break;
        }
        watchdog.look(now);
        if (next == begin) {
            manager.ready();
        }
        manager.feed_watchdog();
        next = std::max(next + between_looks, now);
        std::this_thread::sleep_until(next);
    }
    manager.stopping();
    return 0;
}

int run(int argc, char** argv) {
    CommandLine app(
        "Watches the exhibit and climbs the recovery ladder. The kiosk's service manager starts it.",
        "frustumscreen-watchdog");
    app.set_version_flag("--version", name_and_version("frustumscreen-watchdog"));
    Arguments arguments;
    app.add_option("--run-folder", arguments.run_folder, "folder for its status and its requests")
        .capture_default_str();
    app.add_option("--state-folder", arguments.state_folder, "folder for data that survives a reboot")
        .capture_default_str();
    app.add_option("--start-timeout", arguments.start_timeout_s, "longest start of the exhibit, seconds")
        .within(5.0, 600.0)
        .capture_default_str();
    app.add_option("--root", arguments.places.root, "folder that stands for /, for tests")
        .capture_default_str();
    app.add_option("--seconds", arguments.seconds, "seconds after which to end; 0: run until stopped")
        .within(0.0, 1e6);
    if (const auto end = app.end_of_arguments(argc, argv)) {
        return *end;
    }
    return watch(arguments);
}

} // namespace
} // namespace frustumscreen::programs

int main(int argc, char** argv) {
    return frustumscreen::programs::guarded_main("frustumscreen-watchdog", frustumscreen::programs::run, argc,
                                                 argv);
}
