#include "app/exhibit/placeholder.h"

#include "app/geometry/time_curves.h"

#include <algorithm>

namespace frustumscreen::exhibit {

void Placeholder::begin(std::size_t artifact, MonotonicTime now, const Input& input) {
    picture_ = artifact;
    since_ = now;
    from_ = input.from.value_or(
        typography::TableRectangle{input.to.centre_m, glm::dvec2(0.0), input.to.quarter_turns});
}

/// Brightness of the picture while the shown artifact has the brightness `artifact`.
double Placeholder::light(const Input& input, double artifact) const {
    return replaces_ ? 1.0 - artifact : input.shown.brightness * (1.0 - geometry::ease(arrival_));
}

Placeholder::Output Placeholder::step(MonotonicTime now, const Input& input) {
    const bool other = shown_ != input.shown.artifact; // its brightness is 0 in this step
    const bool gone = !other && !input.shown_ready && arrival_ >= 1.0;
    const bool leaves = input.shown.leaving && (other || !leaving_);
    if (other || gone) {
        arrival_ = input.shown_ready ? 1.0 : 0.0;
        if (!input.shown_ready && picture_) {
            picture_ = input.shown.artifact; // another one was chosen on the way
        } else if (!input.shown_ready) {
            begin(input.shown.artifact, now, input);
        }
    } else if (input.shown_ready) {
        arrival_ = std::min(1.0, arrival_ + to_seconds(now - last_) / to_seconds(fade_time));
    }
    if (leaves) {
        replaces_ = false;
        if (arrival_ >= 1.0) {
            picture_.reset();
            if (!input.chosen_ready) {
                begin(input.chosen, now, input);
                replaces_ = true;
            }
        }
    }
    shown_ = input.shown.artifact;
    leaving_ = input.shown.leaving;
    last_ = now;

    Output output{input.shown.brightness * geometry::ease(arrival_), std::nullopt};
    const double brightness = picture_ ? light(input, output.brightness) : 0.0;
    if (picture_ && brightness <= 0.0 && arrival_ >= 1.0 && !input.shown.leaving) {
        picture_.reset();
        replaces_ = false;
    }
    if (picture_ && brightness > 0.0) {
        const double grown = geometry::ease(to_seconds(now - since_) / to_seconds(growing));
        output.picture = {*picture_,
                          {glm::mix(from_.centre_m, input.to.centre_m, grown),
                           glm::mix(from_.size_m, input.to.size_m, grown), input.to.quarter_turns},
                          brightness};
    }
    return output;
}

} // namespace frustumscreen::exhibit
