/// Decides which behaviours of the artifact on show begin and end.
///
/// Button      each press triggers the artifact's next behaviour with this trigger; after the last comes the first. If
///             that behaviour is still running, the press ends it instead.
/// Dwell       a visitor is present, and for `dwell` has neither moved the prop nor pressed anything.
/// Hotspot     the hotspot's label is shown.
/// Narration   the description has been told for `narration_s`.
/// Arrival     the artifact has faded in.
/// Ends        a behaviour that lasts (it repeats or stays) ends with its trigger: the prop moves on, the label goes, the
///             description is over. Any other behaviour runs to its own end. All end when the visitor has gone, or when
///             another artifact, the staff picture or a new set comes.
///
/// Time     `now` never goes back.
/// Threads  values; one caller. `step` allocates nothing.
/// Errors   none: a behaviour beyond `world::max_behaviours` never begins.
#pragma once

#include "app/world/behaviour.h"
#include "firmware_host/base/time.h"

#include <glm/glm.hpp>

#include <array>
#include <chrono>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace frustumscreen::exhibit {

/// A behaviour of an artifact, as far as the exhibit decides about it.
struct TriggeredBehaviour {
    world::Trigger trigger = world::Trigger::Button;
    std::size_t hotspot = 0;  ///< for Trigger::Hotspot: index into HotspotSet::hotspots
    double narration_s = 0.0; ///< for Trigger::Narration
    bool lasts = false;       ///< it repeats or stays
    /// By CatalogueEntry::languages: its title, what the visitor is told; the height is 0 if there is none.
    std::vector<glm::dvec2> title_sizes_m{};
};

struct BehaviourEvent {
    enum class Kind : std::uint8_t {
        Start,  ///< world::Player::start
        End,    ///< world::Player::end
        Toggle, ///< world::Player::trigger
    };
    std::size_t behaviour = 0; ///< index into CatalogueEntry::behaviours, as the pack has them
    Kind kind = Kind::Start;
};

/// The starts and ends of behaviours in one step; all take effect at the step's `now`.
class BehaviourEvents {
public:
    /// Before the events: everything of every artifact returns to rest; what is not shown may do so at once.
    bool end_all = false;
    /// Events of the artifact on show (Presentation::artifact), in this order; at most one for each behaviour.
    [[nodiscard]] std::span<const BehaviourEvent> events() const { return std::span(events_).first(count_); }
    void add(std::size_t behaviour, BehaviourEvent::Kind kind) {
        events_.at(count_++) = {.behaviour = behaviour, .kind = kind};
    }

private:
    std::array<BehaviourEvent, world::max_behaviours> events_{};
    std::size_t count_ = 0;
};

class BehaviourTriggers {
public:
    static constexpr Nanoseconds dwell = std::chrono::seconds(4);

    struct Input {
        std::span<const TriggeredBehaviour> behaviours; ///< of the artifact on show
        std::size_t artifact = 0;
        bool shown = true;     ///< an artifact is shown: no fault, no staff picture, no change of set
        bool attracts = false; ///< no visitor is there
        bool arrived = true;   ///< the artifact is ready and has faded in
        bool pressed = false;  ///< the button
        Nanoseconds rested{0}; ///< since a visitor who is there moved the prop or pressed anything
        std::optional<std::size_t> hotspot; ///< whose label is shown
        bool tells = false;                 ///< the description is being told
        bool speech_comes = false;          ///< its speech is about to begin
        bool heard = false;                 ///< its speech is heard
    };
    [[nodiscard]] BehaviourEvents step(MonotonicTime now, const Input& input);

    /// The behaviour that the next press triggers; none: the artifact has none for a button.
    [[nodiscard]] static std::optional<std::size_t> next(std::span<const TriggeredBehaviour> behaviours,
                                                         std::size_t presses);
    /// The presses that counted, of the artifact on show.
    [[nodiscard]] std::size_t presses() const { return presses_; }

private:
    void reset(std::size_t artifact);
    void follow_narration(MonotonicTime now, const Input& input);
    /// True while the behaviour's trigger holds; false for a button.
    [[nodiscard]] bool holds(MonotonicTime now, const Input& input,
                             const TriggeredBehaviour& behaviour) const;

    std::size_t artifact_ = 0;
    std::size_t presses_ = 0;
    bool attracted_ = true; ///< in the previous step
    bool silent_ = false;   ///< nothing begins until a visitor or another artifact comes
    bool ended_ = true;     ///< everything was ended, and nothing has begun since
    std::array<bool, world::max_behaviours> held_{}; ///< `holds` in the previous step
    std::optional<MonotonicTime> told_since_;
    bool heard_ = false; ///< speech of the current description has been heard
};

} // namespace frustumscreen::exhibit
