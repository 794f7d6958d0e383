/// Pixels of the drift marks right after a calibration; later sets are compared with them.
///
/// Form     JSON, a small file next to the kept calibrations; positions only, no picture.
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

namespace frustumscreen::drift {

inline constexpr std::size_t max_marks = 10;
/// In the folder of the kept calibrations.
inline constexpr const char* drift_file = "drift.json";

/// A tag that is fixed on the table.
struct AnchorTag {
    int id = 0;
    std::array<glm::dvec2, 4> corners_px{};
};

/// The result of one look at all marks.
struct MarkSet {
    MonotonicTime time{};
    std::vector<std::optional<glm::dvec2>> marks_px; ///< by mark; nullopt: not seen
    std::vector<AnchorTag> anchors;
    [[nodiscard]] std::size_t seen() const;
};

struct DriftReference {
    int width = 0, height = 0;                       ///< of the camera's frames
    std::vector<glm::dvec2> marks_m;                 ///< lit places on the table
    std::vector<std::optional<glm::dvec2>> marks_px; ///< one for each mark
    std::vector<AnchorTag> anchors;

    /// Whether the reference belongs to a projector calibration that lights the marks at `marks_m`. Another
    /// projector calibration shifts them at least slightly; one that only changes the eye or the tracker does
    /// not.
    [[nodiscard]] bool fits(const std::vector<glm::dvec2>& marks_m) const;
};

[[nodiscard]] std::string drift_reference_text(const DriftReference& reference);
[[nodiscard]] Result<DriftReference> parse_drift_reference(std::string_view text, std::string_view file);

} // namespace frustumscreen::drift
