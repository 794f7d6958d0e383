#include "app/programs/frustumscreen/wait_for_display.h"

#include "firmware_host/base/sentence.h"

namespace frustumscreen {

namespace {

constexpr Nanoseconds between_looks_for_card = std::chrono::seconds(1);

} // namespace

Result<std::unique_ptr<Display>> wait_for_display(const DisplaySearch& search,
                                                  const StopSignals& stop_signals, ServiceManager& manager,
                                                  const Journal& journal) {
    std::unique_ptr<Hotplug> hotplug; // made when it has to wait
    Sentence noted;
    const MonotonicTime begin = search.now();
    while (true) {
        Result<std::unique_ptr<Display>> display = search.make();
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
            journal.note(LogPriority::Warning, why.view(), {{"DEVICE", "display"}});
        }
        manager.status(why);
        manager.still_starting(10 * between_looks_for_card);
        const StopSignals::AtOnce at_once(stop_signals); // nothing to close yet
        static_cast<void>(hotplug->wait(between_looks_for_card));
    }
}

} // namespace frustumscreen
