/// A kiosk as a watchdog sees it, second by second: the exhibit's process with systemd's restart and
/// watchdog, the machine, and its current faults.
///
/// Times    in whole seconds, for a PC with a GPU: 15 s from reset to the service manager, 4 s from the
///          exhibit's start to its picture, 1 s before systemd restarts a process that ended, 10 s before its
///          watchdog ends one that hangs.
/// Threads  values; one caller.
#pragma once

#include "app/watch/outcome.h"
#include "app/watch/step.h"
#include "tests/simulators/museum/fault_kinds.h"

#include <optional>
#include <vector>

namespace frustumscreen::simulators {

/// The exhibit as the visitors see it.
enum class VisibleState : std::uint8_t {
    Whole,     ///< the museum's own exhibit, working
    Untracked, ///< the museum's own exhibit, but it does not follow the prop
    BuiltIn,   ///< the built-in artifact
    Words,     ///< text for the staff
    Dark,      ///< nothing, or a frozen picture
};
inline constexpr std::size_t visible_state_count = 5;

class KioskModel {
public:
    static constexpr MuseumTime boot_s = 15;
    static constexpr MuseumTime start_s = 4;
    static constexpr MuseumTime restart_s = 1;
    static constexpr MuseumTime systemd_watchdog_s = 10;
    static constexpr MuseumTime hardware_watchdog_s = 20;
    static constexpr MuseumTime leak_s = 7200;

    void fault_event(const FaultEvent& fault_event, MuseumTime now);
    /// Advances by a second. `Outcome` is the visible state afterwards; nullopt while the machine boots.
    std::optional<watch::Outcome> pass(MuseumTime now);
    void take(watch::Step step, watch::Mode mode, MuseumTime now);
    /// Sets the mode that a watchdog chooses after a boot.
    void show(watch::Mode mode) { mode_ = mode; }

    [[nodiscard]] VisibleState shown() const;
    [[nodiscard]] bool is_booting(MuseumTime now) const { return now < boots_until_; }
    [[nodiscard]] bool is_ill() const { return !fault_events_.empty(); }
    [[nodiscard]] bool has(FaultKind fault) const;

private:
    void begin_process(MuseumTime now);
    void end_process(MuseumTime now, bool failed);
    void boot(MuseumTime now, MuseumTime after_s);
    void end_by(unsigned remedies);
    void live(MuseumTime now);
    [[nodiscard]] bool ends_soon_after_start() const;
    [[nodiscard]] bool gives_no_picture() const;

    std::vector<FaultEvent> fault_events_;
    watch::Mode mode_ = watch::Mode::Normal;
    MuseumTime boots_until_ = 0;
    std::optional<MuseumTime> began_; ///< start of the exhibit's process
    MuseumTime begins_at_ = 0;        ///< when systemd starts it
    bool is_lit_ = false;
    std::optional<MuseumTime> hangs_since_;
    std::int32_t process_ = 1;
    std::uint32_t failures_ = 0;
    std::uint64_t pictures_ = 0, safe_pictures_ = 0;
    MuseumTime heard_ = 0; ///< time of its latest status
    double memory_ = 0.2;
};

} // namespace frustumscreen::simulators
