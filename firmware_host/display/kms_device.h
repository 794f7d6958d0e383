/// What the presenter needs of a graphics card; the kernel's answers are values.
///
/// Threads  the render thread; only `wait_flip` blocks, for as long as it is told to.
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

namespace frustumscreen {

enum class KmsAnswer : std::uint8_t {
    Done,      ///< queued
    Busy,      ///< what was queued before is not done
    Refused,   ///< the card cannot do it
    NotMaster, ///< another program holds the screen
    Gone,      ///< the card is not there any more
};

/// The kernel's number of a framebuffer.
using FramebufferId = std::uint32_t;

/// What is scanned out: a whole framebuffer, at `place` on the screen; black around it.
struct ScannedOut {
    FramebufferId framebuffer = 0;
    PixelSize size;
    PixelRectangle place;
};

struct Flipped {
    MonotonicTime time;
    std::uint64_t ticket = 0; ///< of the call that asked for it
};

class KmsDevice {
public:
    virtual ~KmsDevice() = default;
    /// Shows the framebuffer in this mode on this connector and turns off everything else on the card; a flip
    /// follows. Refused also where the card cannot scale it to its place.
    [[nodiscard]] virtual KmsAnswer light(std::uint32_t connector, const ModeTiming& mode,
                                          const ScannedOut& shown, std::uint64_t ticket) = 0;
    /// Shows another framebuffer of the same size from the next refresh on; a flip follows.
    [[nodiscard]] virtual KmsAnswer flip(FramebufferId shown, std::uint64_t ticket) = 0;
    /// Turns off what `light` turned on.
    [[nodiscard]] virtual KmsAnswer darken() = 0;
    /// Takes the screen, if no other program holds it.
    [[nodiscard]] virtual bool become_master() = 0;
    /// The next flip that is done; waits for it at most `at_most`, 0 = not at all.
    [[nodiscard]] virtual std::optional<Flipped> wait_flip(Nanoseconds at_most) = 0;
    /// Do the flips come in time with the refreshes of what is lit? An emulated card's come at once. False at
    /// least until the first flip after `light`.
    [[nodiscard]] virtual bool flips_keep_time() const = 0;
    /// A clause about what may be wrong with the lit output and cannot be set from here; empty: nothing.
    [[nodiscard]] virtual std::string_view shortcoming() const { return {}; }
    [[nodiscard]] virtual MonotonicTime now() const = 0;
};

/// Two framebuffers of one size that a card can show, and how the exhibit's picture gets into them.
class ScanoutPair {
public:
    virtual ~ScanoutPair() = default;
    [[nodiscard]] virtual PixelSize size() const = 0;
    /// Copies `part` of the picture into framebuffer 0 or 1; the copy is complete when it returns.
    [[nodiscard]] virtual FramebufferId fill(int which, const PixelRectangle& part) = 0;
    /// Reads the first pixels of a framebuffer's top row, RGBA codes; false: they cannot be read.
    [[nodiscard]] virtual bool read(int /*which*/, std::span<std::byte> /*rgba*/) const { return false; }
};
using MakeScanout = std::function<Result<std::unique_ptr<ScanoutPair>>(PixelSize size)>;

} // namespace frustumscreen
