/// Unmutes a sound card whose mixer controls are muted, which is Linux' default for a new card.
///
/// Controls 'Master', 'PCM', 'Speaker' and similar: one that is switched off or at its minimum is switched on and set
///          to 0 dB. A control that was set by hand, however low, stays unchanged.
/// Errors   none: a card without such controls, or one that refuses, is left unchanged.
/// Threads  one caller; it may take as long as opening the card.
#pragma once

namespace frustumscreen::sound {

/// `card` is ALSA's number; negative: no card, no effect.
void wake_controls(int card);

} // namespace frustumscreen::sound
