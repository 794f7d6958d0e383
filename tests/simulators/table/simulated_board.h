/// A ray-cast table during calibration by a camera: the projector's picture falls on the printed tag sheet
/// and its prop, a camera captures it frame by frame, and a tracker reports.
///
/// Shares no arithmetic with the code under test, as in simulated_table.h; it knows only the print on the tag
/// sheet and the stripes that are shown.
/// Light    a picture appears on the table `latency_s` after it was sent. Each row of a frame has its own
///          exposure, one after the other, and integrates what is shown meanwhile.
/// Frames   table T; camera pixels follow the convention of the projector's.
/// Threads  values; any.
#pragma once

#include "app/calibration/board.h"
#include "app/image/image.h"
#include "firmware_host/camera/camera.h"
#include "tests/simulators/table/simulated_camera.h"

#include <functional>
#include <list>
#include <set>

namespace frustumscreen::simulators {

struct BoardFaults {
    CaptureFaults light;
    double latency_s = 0.045;   ///< of the projector
    double exposure_s = 0.0167; ///< per row
    double readout_s = 0.02;    ///< from the first row's exposure to the last one's
};

class SimulatedBoard {
public:
    SimulatedBoard(const SimulatedTable& table, const SimulatedCamera& camera, calibration::Board board,
                   const calibration::StripeSetup& stripes, const BoardFaults& faults, std::uint64_t seed);

    /// Places the prop with its tag sheet. `covered`: tags covered by a hand.
    void put(const glm::dmat4& table_from_prop, std::set<int> covered = {});
    /// Shades the projector's light from now on: whether something blocks it at a pixel's place.
    using Shade = std::function<bool(const glm::dvec2& pixel)>;
    void shade(MonotonicTime from, Shade shade);
    /// Shows a pattern, or a picture of text.
    void show(MonotonicTime given_out, const calibration::Pattern& pattern);
    void show(MonotonicTime given_out, const image::Image8& words);
    /// `begin`: start of the first row's exposure, which is the frame's time.
    [[nodiscard]] camera::CameraFrame frame(MonotonicTime begin);

private:
    /// One of a pixel's rays.
    struct Sample {
        std::uint32_t pixel = 0; ///< of the camera
        float weight = 1.0F;
        float albedo = 0.0F;
        float u = -1.0F, v = -1.0F; ///< of the projector; negative: unlit
    };
    struct Shown {
        MonotonicTime from; ///< on the table since
        std::optional<calibration::Pattern> pattern;
        std::vector<float> words;    ///< light of each pixel of the projector
        Shade shade;                 ///< may be empty
        std::vector<double> light{}; ///< seen by each pixel of the camera; empty: not yet computed
    };
    void cast();
    void light(Shown& shown) const;

    SimulatedTable table_;
    SimulatedCamera camera_;
    calibration::Board board_;
    calibration::StripeSetup stripes_;
    BoardFaults faults_;
    SeededNumbers numbers_;
    std::vector<float> normals_; ///< noise, read from a random offset on
    glm::dmat4 table_from_prop_{1.0};
    std::set<int> covered_;
    std::vector<Sample> samples_;
    std::list<Shown> shown_; ///< the latest is last
};

} // namespace frustumscreen::simulators
