/// Where a camera saw the marks of light right after a calibration: what later looks are held against.
///
/// Form     JSON, a small file beside the kept calibrations; places alone, no picture.
/// Frames   the camera's pixels; the table T, metres.
/// Threads  values; any.
#pragma once

#include "firmware_host/base/result.h"
#include "firmware_host/base/time.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen {

inline constexpr std::size_t most_marks = 10;
/// In the folder of the kept calibrations.
inline constexpr const char* drift_file = "drift.json";

/// A tag that lies on the table for good.
struct AnchorTag {
    int id = 0;
    std::array<glm::dvec2, 4> corners_px{};
};

/// What one look at all marks found.
struct MarkSet {
    MonotonicTime time{};
    std::vector<std::optional<glm::dvec2>> marks_px; ///< by mark; nothing: it was not seen
    std::vector<AnchorTag> anchors;
    [[nodiscard]] std::size_t seen() const;
};

struct DriftReference {
    int width = 0, height = 0;                       ///< of the camera's frames
    std::vector<glm::dvec2> marks_m;                 ///< where they were lit on the table
    std::vector<std::optional<glm::dvec2>> marks_px; ///< as many
    std::vector<AnchorTag> anchors;

    /// Whether it is of a projector that lights the marks there. Another calibration of it lights them at least a little beside; one that
    /// has another eye or tracker alone leaves them where they are.
    [[nodiscard]] bool fits(const std::vector<glm::dvec2>& marks_m) const;
};

[[nodiscard]] std::string drift_reference_text(const DriftReference& reference);
[[nodiscard]] Result<DriftReference> parse_drift_reference(std::string_view text, std::string_view file);

} // namespace frustumscreen
