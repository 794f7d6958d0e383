#include "firmware_host/sound/alsa_controls.h"

#include <alsa/asoundlib.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string_view>

namespace frustumscreen::sound {

namespace {

struct CloseMixer {
    void operator()(snd_mixer_t* mixer) const { ::snd_mixer_close(mixer); }
};
using Controls = std::unique_ptr<snd_mixer_t, CloseMixer>;

/// Controls between a program and a loudspeaker; no microphone or beeper controls.
constexpr std::array<std::string_view, 10> ways_out = {
    "Master", "PCM", "Front", "Speaker", "Headphone", "Line Out", "Lineout", "Digital", "IEC958", "HDMI"};

bool is_way_out(snd_mixer_elem_t* control) {
    const std::string_view name = ::snd_mixer_selem_get_name(control);
    return std::find(ways_out.begin(), ways_out.end(), name) != ways_out.end();
}

bool is_switched_off(snd_mixer_elem_t* control) {
    int on = 1;
    return ::snd_mixer_selem_has_playback_switch(control) != 0 &&
           ::snd_mixer_selem_get_playback_switch(control, SND_MIXER_SCHN_FRONT_LEFT, &on) == 0 && on == 0;
}

bool is_at_its_lowest(snd_mixer_elem_t* control) {
    long least = 0;
    long most = 0;
    long volume = 0;
    return ::snd_mixer_selem_has_playback_volume(control) != 0 &&
           ::snd_mixer_selem_get_playback_volume_range(control, &least, &most) == 0 && least < most &&
           ::snd_mixer_selem_get_playback_volume(control, SND_MIXER_SCHN_FRONT_LEFT, &volume) == 0 &&
           volume == least;
}

void wake(snd_mixer_elem_t* control) {
    if (is_at_its_lowest(control) && ::snd_mixer_selem_set_playback_dB_all(control, 0, -1) < 0) {
        long least = 0;
        long most = 0;
        ::snd_mixer_selem_get_playback_volume_range(control, &least, &most);
        ::snd_mixer_selem_set_playback_volume_all(control, most); // the control has no decibel scale
    }
    if (is_switched_off(control)) {
        ::snd_mixer_selem_set_playback_switch_all(control, 1);
    }
}

} // namespace

void wake_controls(int card) {
    snd_mixer_t* raw = nullptr;
    if (card < 0 || ::snd_mixer_open(&raw, 0) < 0) {
        return;
    }
    const Controls controls(raw);
    const std::string name = fmt::format("hw:{}", card);
    if (::snd_mixer_attach(raw, name.c_str()) < 0 || ::snd_mixer_selem_register(raw, nullptr, nullptr) < 0 ||
        ::snd_mixer_load(raw) < 0) {
        return;
    }
    for (snd_mixer_elem_t* control = ::snd_mixer_first_elem(raw); control != nullptr;
         control = ::snd_mixer_elem_next(control)) {
        if (is_way_out(control)) {
            wake(control);
        }
    }
}

} // namespace frustumscreen::sound
