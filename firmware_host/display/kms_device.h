/// The presenter's interface to a graphics card; the kernel's answers are values.
///
/// Threads  the render thread; only `wait_flip` blocks, no longer than its limit.
#pragma once

#include "firmware_host/base/result.h"
#include "firmware_host/base/time.h"
#include "firmware_host/display/kms_mode.h"
#include "firmware_host/display/letterbox.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

namespace frustumscreen::display {

enum class KmsAnswer : std::uint8_t {
    Done,      ///< queued
    Busy,      ///< the previous commit is not done
    Refused,   ///< the card cannot do it
    NotMaster, ///< another program holds the screen
    Gone,      ///< the card is no longer there
};

/// The kernel's number of a framebuffer.
using FramebufferId = std::uint32_t;

/// A scanned-out framebuffer: its first rows, shown at `place` on the screen, with black around it.
struct ScannedOut {
    FramebufferId framebuffer = 0;
    PixelSize size; ///< of what is shown
    PixelRectangle place;
};

struct Flipped {
    MonotonicTime time;
    std::uint64_t ticket = 0;  ///< ticket of the call that requested it
    std::uint32_t refresh = 0; ///< number of the refresh that shows it; the card counts its refreshes
    KmsAnswer answer = KmsAnswer::Done; ///< any other: the flip failed after it was queued
};

class KmsDevice {
public:
    virtual ~KmsDevice() = default;
    /// Shows the framebuffer in this mode on this connector and turns off everything else on the card; a flip
    /// follows. Refused also if the card cannot scale the framebuffer to its place.
    [[nodiscard]] virtual KmsAnswer light(std::uint32_t connector, const ModeTiming& mode,
                                          const ScannedOut& shown, std::uint64_t ticket) = 0;
    /// Shows another framebuffer of the same size from the next refresh on; a flip follows.
    [[nodiscard]] virtual KmsAnswer flip(FramebufferId shown, std::uint64_t ticket) = 0;
    /// As `flip`, shown from this row on. Refused also if the card cannot change the row in a flip.
    [[nodiscard]] virtual KmsAnswer flip_from(int /*first_row*/, FramebufferId /*shown*/,
                                              std::uint64_t /*ticket*/) {
        return KmsAnswer::Refused;
    }
    /// Turns off the output that `light` turned on.
    [[nodiscard]] virtual KmsAnswer darken() = 0;
    /// Takes the screen, unless another program holds it.
    [[nodiscard]] virtual bool become_master() = 0;
    /// The next completed flip; waits for it at most `at_most`, 0 = not at all.
    [[nodiscard]] virtual std::optional<Flipped> wait_flip(Nanoseconds at_most) = 0;
    /// Whether flips keep time with the refreshes of the lit output; an emulated card's flips come at once.
    /// False at least until the first flip after `light`.
    [[nodiscard]] virtual bool flips_keep_time() const = 0;
    /// A clause about a possible fault of the lit output that cannot be fixed from here; empty: none.
    [[nodiscard]] virtual std::string_view shortcoming() const { return {}; }
    /// Whether the refreshes of the lit output show the halves of a framebuffer in turn (EyeLayout::InTurn).
    [[nodiscard]] virtual bool in_turn() const { return false; }
    /// The card's name, for sentences.
    [[nodiscard]] virtual std::string_view card() const { return "the graphics card"; }
    /// Time until which the device's own thread has promised a sign of life; nullopt: there is no such thread.
    [[nodiscard]] virtual std::optional<MonotonicTime> alive_until() const { return std::nullopt; }
    [[nodiscard]] virtual MonotonicTime now() const = 0;
};

/// Two framebuffers of equal size that a card can scan out, and the copy of the exhibit's picture into them.
class ScanoutPair {
public:
    virtual ~ScanoutPair() = default;
    [[nodiscard]] virtual PixelSize size() const = 0;
    /// Copies `part` of the picture into framebuffer 0 or 1; the copy is complete on return.
    [[nodiscard]] virtual FramebufferId fill(int which, const PixelRectangle& part) = 0;
    /// Reads the first pixels of a framebuffer's top row, as RGBA codes; false: they cannot be read.
    [[nodiscard]] virtual bool read(int /*which*/, std::span<std::byte> /*rgba*/) const { return false; }
};
using MakeScanout = std::function<Result<std::unique_ptr<ScanoutPair>>(PixelSize size)>;

} // namespace frustumscreen::display
