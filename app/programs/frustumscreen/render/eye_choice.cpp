#include "app/programs/frustumscreen/render/eye_choice.h"

namespace frustumscreen::programs {

Result<EyeChoice> choose_eye(std::string_view eye, settings::Stereo stereo, bool one_eye) {
    if (eye == "left") {
        return EyeChoice::Left;
    }
    if (eye == "right") {
        return EyeChoice::Right;
    }
    if (stereo == settings::Stereo::Off) {
        if (eye == "both") {
            return bad_input("render.no_stereo",
                             "--eye both: the settings have no layout for two eyes; set eye.stereo, "
                             "or draw --eye left and --eye right by themselves");
        }
        return EyeChoice::Middle;
    }
    if (one_eye) {
        return bad_input("render.one_eye",
                         "--aov and --view visitor show what one eye sees, and the settings' layout "
                         "has two; add --eye left or --eye right");
    }
    return EyeChoice::Both;
}

std::vector<glm::dvec3> chosen_eyes(EyeChoice choice, const tracking::TrackedState& state,
                                    double interocular_m) {
    const auto [left, right] = tracking::eyes_of(state, interocular_m);
    switch (choice) {
    case EyeChoice::Middle:
        return {state.eye_m};
    case EyeChoice::Left:
        return {left};
    case EyeChoice::Right:
        return {right};
    case EyeChoice::Both:
        return {left, right};
    }
    return {};
}

} // namespace frustumscreen::programs
