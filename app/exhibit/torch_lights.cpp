#include "app/exhibit/torch_lights.h"

#include "app/geometry/time_curves.h"

#include <algorithm>

namespace frustumscreen::exhibit {

namespace {

/// A share from which a torch counts as taken: half of its light.
constexpr double taken_share = 0.5;

tracking::TorchTwist twist_of(const TorchPlace& place) {
    return tracking::TorchTwist({.usual_rad = place.beam.opening_rad,
                                 .min_rad = place.min_opening_rad,
                                 .max_rad = place.max_opening_rad});
}

} // namespace

TorchLights::TorchLights(const TorchPlace& place)
    : place_(place), torches_{Torch{.twist = twist_of(place), .began = {}},
                              Torch{.twist = twist_of(place), .began = {}}} {}

std::optional<std::size_t> TorchLights::content() const {
    const std::size_t goal = held_ ? torches_.at(*held_).content.goal() : contents_;
    return goal < contents_ ? std::optional(goal) : std::nullopt;
}

torch::Beam TorchLights::beam_of(const Torch& torch) const {
    torch::Beam beam = place_.beam;
    beam.opening_rad = torch.twist.opening_rad();
    return beam;
}

/// Its contents begin at once: the new artifact fades in by itself.
void TorchLights::begin_artifact(MonotonicTime now, std::size_t artifact) {
    artifact_ = artifact;
    for (Torch& torch : torches_) {
        torch.content = Fade(0, changes_in, now - changes_in);
        torch.threw = 0;
        torch.began = now;
    }
    left_.fill(std::nullopt);
}

void TorchLights::follow(MonotonicTime now, const Input& input, std::size_t number) {
    const tracking::TrackedTorch& tracked = input.tracked_state.torches.at(number);
    Torch& torch = torches_.at(number);
    const bool on = tracked.share > 0.0;
    if (on && !torch.on) {
        torch.twist.begin(tracked.table_from_torch.rotation);
    } else if (on) {
        torch.twist.follow(tracked.table_from_torch.rotation);
    }
    torch.on = on;
    if (tracked.share < taken_share) {
        torch.taken.reset();
    } else if (!torch.taken) {
        torch.taken = now;
    }
    const std::size_t throws = torch.content.at(now).which;
    torch.began = throws != torch.threw ? now : torch.began;
    torch.threw = throws;
}

PresentedLight TorchLights::light_of(MonotonicTime now, const Input& input, std::size_t number) const {
    const tracking::TrackedTorch& tracked = input.tracked_state.torches.at(number);
    const Torch& torch = torches_.at(number);
    const Faded content = torch.content.at(now);
    return {.table_from_torch = tracked.table_from_torch,
            .content = content.which < input.contents ? std::optional(content.which) : std::nullopt,
            .seconds = to_seconds(now - torch.began),
            .opening_rad = torch.twist.opening_rad(),
            .brightness = tracked.share * content.brightness * input.light,
            .colour = number};
}

/// Replaces the oldest light if the limit is reached.
void TorchLights::leave(MonotonicTime now, const Input& input, const PresentedLight& light) {
    const auto is_older = [](const std::optional<LeftLight>& a, const std::optional<LeftLight>& b) {
        return a && b ? a->number < b->number : !a && b;
    };
    *std::min_element(left_.begin(), left_.end(), is_older) =
        LeftLight{.prop_from_torch = input.table_from_prop.inverse() * light.table_from_torch,
                  .light = light,
                  .began = now - Nanoseconds(std::llround(1e9 * light.seconds)),
                  .number = ++lefts_};
}

void TorchLights::add_left(MonotonicTime now, const Input& input, PresentedTorches& presented) {
    const double dt_s = last_ ? to_seconds(now - *last_) : 0.0;
    for (std::optional<LeftLight>& left : left_) {
        if (!left) {
            continue;
        }
        left->goes = left->goes || input.gone;
        left->progress =
            std::clamp(left->progress + (left->goes ? -dt_s / left_goes_s : dt_s / left_comes_s), 0.0, 1.0);
        if (left->goes && left->progress <= 0.0) {
            left.reset();
            continue;
        }
        PresentedLight light = left->light;
        light.table_from_torch = input.table_from_prop * left->prop_from_torch;
        light.seconds = to_seconds(now - left->began);
        light.brightness = geometry::ease(left->progress) * input.light;
        light.left = true;
        if (light.brightness > 0.0) {
            presented.add(light);
        }
    }
}

PresentedTorches TorchLights::step(MonotonicTime now, const Input& input) {
    if (artifact_ != input.artifact) {
        begin_artifact(now, input.artifact);
    }
    contents_ = input.contents;
    double most = 0.0;
    held_.reset();
    for (std::size_t k = 0; k < torches_.size(); ++k) {
        follow(now, input, k);
        most = std::max(most, input.tracked_state.torches.at(k).share);
        if (torches_.at(k).taken && (!held_ || *torches_.at(k).taken > *torches_.at(*held_).taken)) {
            held_ = k;
        }
    }
    aim_.reset();
    if (held_) {
        Torch& torch = torches_.at(*held_);
        aim_ = aim_of(beam_of(torch), input.tracked_state.torches.at(*held_).table_from_torch, input.object);
        if (input.next && contents_ > 0) {
            torch.content.change_to((torch.content.goal() + 1) % (contents_ + 1), now, now);
        }
    }
    PresentedTorches presented;
    presented.held = held_;
    presented.aim = aim_;
    presented.house_light = 1.0 - most * (1.0 - place_.house_light);
    for (std::size_t k = 0; k < torches_.size(); ++k) {
        const PresentedLight light = light_of(now, input, k);
        if (light.brightness > 0.0) {
            presented.add(light);
        }
        if (input.leave && held_ == k && aim_ == TorchAim::Lights) {
            leave(now, input, light);
        }
    }
    add_left(now, input, presented);
    last_ = now;
    return presented;
}

} // namespace frustumscreen::exhibit
