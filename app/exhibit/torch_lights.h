/// Decides what each torch throws onto the artifact: its content, its opening, its colour, and the lights that visitors
/// left on.
///
/// Content   of the artifact's pack, in its order, then plain light; `next` goes on by one, through a short darkness. It
///           is that of the torch that was taken last. Another artifact begins with its first content.
/// Left      a torch's light that a visitor left on the object stays there, in the prop's frame, while the prop is turned
///           and the torch goes elsewhere: the next visitor sees what was pointed at. At most two; a third takes the place
///           of the oldest. All end when the visitor has gone or the artifact changes.
/// Colour    two torches are told apart by the colour of plain light and effects; pictures and layers keep theirs.
/// Frames    table T.
/// Time      `now` never goes back.
/// Threads   values; one caller. `step` allocates nothing.
#pragma once

#include "app/exhibit/fade.h"
#include "app/exhibit/torch_aim.h"
#include "app/torch/torch.h"
#include "app/tracking/torch_twist.h"
#include "app/tracking/tracked_state.h"

#include <array>
#include <cstddef>
#include <optional>
#include <span>

namespace frustumscreen::exhibit {

/// A kiosk's torches.
struct TorchPlace {
    torch::Beam beam; ///< the opening without a twist
    double min_opening_rad = 0.0, max_opening_rad = 0.0;
    double house_light = 1.0; ///< share of the artifact's light while a torch is held
};

/// A light, as it is drawn.
struct PresentedLight {
    geometry::RigidTransform table_from_torch;
    std::optional<std::size_t> content; ///< of the artifact's pack; none: plain light
    double seconds = 0.0;               ///< since it began to throw its content
    double opening_rad = 0.0;           ///< of the torch
    double brightness = 0.0;            ///< above 0, up to 1
    std::size_t colour = 0;             ///< index into torch_colours
    bool left = false;                  ///< a visitor left it on the object
};
/// The colours of plain light and effects: the tracker's torch, and the lamp that a camera sees.
inline constexpr std::array<glm::vec3, tracking::max_tracked_torches> torch_colours{
    {{1.0F, 1.0F, 1.0F}, {0.55F, 0.80F, 1.0F}}};

class PresentedTorches {
public:
    double house_light = 1.0;        ///< factor of the artifact's light
    std::optional<std::size_t> held; ///< the torch that was taken last: 0 the tracker's, 1 a camera's
    std::optional<TorchAim> aim;     ///< of the held one
    [[nodiscard]] std::span<const PresentedLight> lights() const { return std::span(lights_).first(count_); }
    void add(const PresentedLight& light) { lights_.at(count_++) = light; }

private:
    std::array<PresentedLight, torch::max_torches> lights_{};
    std::size_t count_ = 0;
};

class TorchLights {
public:
    static constexpr std::size_t max_left = torch::max_torches - tracking::max_tracked_torches;
    static constexpr Nanoseconds changes_in = std::chrono::milliseconds(150); ///< each way
    static constexpr double left_comes_s = 0.5, left_goes_s = 1.0;

    explicit TorchLights(const TorchPlace& place);

    struct Input {
        const tracking::TrackedState& tracked_state;
        geometry::RigidTransform table_from_prop; ///< as drawn
        std::size_t artifact = 0;
        std::size_t contents = 0; ///< of its pack
        LitObject object;         ///< table frame
        double light = 1.0;       ///< of the artifact: 0..1
        bool next = false;        ///< the next content
        bool leave = false;       ///< the light stays on the object
        bool gone = false;        ///< no visitor is there
    };
    [[nodiscard]] PresentedTorches step(MonotonicTime now, const Input& input);

    /// True if a torch is in a hand, so that it has two buttons, as of the latest step.
    [[nodiscard]] bool held() const { return held_.has_value(); }
    /// The content that the torch in the hand throws, or will in a moment; none: plain light, or none is held.
    [[nodiscard]] std::optional<std::size_t> content() const;
    /// Where the light of the torch in the hand goes; none: no torch is held.
    [[nodiscard]] const std::optional<TorchAim>& aim() const { return aim_; }

private:
    struct Torch {
        tracking::TorchTwist twist;
        Fade content{0, changes_in, MonotonicTime{}};
        MonotonicTime began; ///< to throw its content
        std::size_t threw = 0;
        bool on = false;
        std::optional<MonotonicTime> taken{};
    };
    struct LeftLight {
        geometry::RigidTransform prop_from_torch;
        PresentedLight light; ///< as it was left
        MonotonicTime began;
        double progress = 0.0; ///< of its fade
        bool goes = false;
        std::size_t number = 0; ///< counted
    };

    void begin_artifact(MonotonicTime now, std::size_t artifact);
    void follow(MonotonicTime now, const Input& input, std::size_t number);
    [[nodiscard]] PresentedLight light_of(MonotonicTime now, const Input& input, std::size_t number) const;
    void leave(MonotonicTime now, const Input& input, const PresentedLight& light);
    void add_left(MonotonicTime now, const Input& input, PresentedTorches& presented);
    [[nodiscard]] torch::Beam beam_of(const Torch& torch) const;

    TorchPlace place_;
    std::array<Torch, tracking::max_tracked_torches> torches_;
    std::array<std::optional<LeftLight>, max_left> left_{};
    std::size_t lefts_ = 0; ///< lights left so far
    std::optional<std::size_t> artifact_;
    std::size_t contents_ = 0;
    std::optional<std::size_t> held_; ///< the torch that was taken last
    std::optional<TorchAim> aim_;
    std::optional<MonotonicTime> last_;
};

} // namespace frustumscreen::exhibit
