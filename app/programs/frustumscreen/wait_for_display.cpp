#include "app/programs/frustumscreen/wait_for_display.h"

#include "firmware_host/base/sentence.h"

namespace frustumscreen::programs {

namespace {

constexpr Nanoseconds between_looks_for_card = std::chrono::seconds(1);

} // namespace

Result<std::unique_ptr<display::Display>> wait_for_display(const DisplaySearch& search,
                                                           const service::StopSignals& stop_signals,
                                                           service::ServiceManager& manager,
                                                           const service::Journal& journal) {
    std::unique_ptr<display::Hotplug> hotplug; // made when it has to wait
    Sentence noted;
    const MonotonicTime begin = search.now();
    while (true) {
        Result<std::unique_ptr<display::Display>> display = search.make();
        if (display || !manager.listens()) {
            return display;
        }
        const bool may_come = display.error().kind == ErrorKind::DeviceLost;
        if (!may_come && search.now() - begin >= longest_boot) {
            return display;
        }
        if (!hotplug) {
            hotplug = search.make_hotplug();
        }
        const Sentence why(display.error().message);
        if (why != noted) {
            noted = why;
            journal.note(service::LogPriority::Warning, why.view(), {{"DEVICE", "display"}});
        }
        manager.status(why);
        manager.still_starting(10 * between_looks_for_card);
        const service::StopSignals::AtOnce at_once(stop_signals); // nothing to close yet
        static_cast<void>(hotplug->wait(between_looks_for_card));
    }
}

} // namespace frustumscreen::programs
