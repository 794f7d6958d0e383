/// Wakes a sound card whose own controls are muted, as Linux leaves them when it meets a card for the first time.
///
/// What     its 'Master', 'PCM', 'Speaker' and the like, where one is switched off or at its lowest: switched on
///          and to 0 dB. A control that somebody has set, however low, stays as it is.
/// Errors   none: a card without such controls, or one that refuses, is left as it is.
/// Threads  one caller; it may take as long as opening the card.
#pragma once

namespace frustumscreen {

/// `card` by its number in ALSA; negative: no card, nothing is done.
void wake_controls(int card);

} // namespace frustumscreen
