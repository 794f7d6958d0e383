/// A table while it is calibrated by a camera, ray cast: what is shown lies on the printed board and on its prop, a camera looks at it frame by frame,
/// and a tracker reports.
///
/// The arithmetic is its own, as in simulated_table.h; of the board it knows what is printed, of the stripes what is shown.
/// Light    a picture lies on the table `latency_s` after it is given out. Each row of a frame is exposed for itself, one after the other, and sees
///          what lies there meanwhile.
/// Frames   table T; the camera's pixels as the projector's.
/// Threads  values; any.
#pragma once

#include "app/calibration/board.h"
#include "app/image/image.h"
#include "firmware_host/camera/camera.h"
#include "tests/simulators/table/simulated_camera.h"

#include <functional>
#include <list>
#include <set>

namespace frustumscreen {

struct BoardFaults {
    CaptureFaults light;
    double latency_s = 0.045;   ///< of the projector
    double exposure_s = 0.0167; ///< of a row
    double readout_s = 0.02;    ///< from the first row's exposure to the last one's
};

class SimulatedBoard {
public:
    SimulatedBoard(const SimulatedTable& table, const SimulatedCamera& camera, Board board,
                   const StripeSetup& stripes, const BoardFaults& faults, std::uint64_t seed);

    /// Puts the prop with its board there. `covered`: tags on which a hand lies.
    void put(const glm::dmat4& table_from_prop, std::set<int> covered = {});
    /// Of the projector's light, from now on: whether something keeps it away from a pixel's place.
    using Shade = std::function<bool(const glm::dvec2& pixel)>;
    void shade(MonotonicTime from, Shade shade);
    /// A pattern, or words as they are drawn.
    void show(MonotonicTime given_out, const Pattern& pattern);
    void show(MonotonicTime given_out, const Image8& words);
    /// The exposure of its first row begins then; that is its time.
    [[nodiscard]] CameraFrame frame(MonotonicTime begin);

private:
    /// One ray, or a share of a pixel's.
    struct Sample {
        std::uint32_t pixel = 0; ///< of the camera
        float weight = 1.0F;
        float albedo = 0.0F;
        float u = -1.0F, v = -1.0F; ///< of the projector; negative: no light comes
    };
    struct Shown {
        MonotonicTime from; ///< lies on the table since
        std::optional<Pattern> pattern;
        std::vector<float> words;    ///< light of each pixel of the projector
        Shade shade;                 ///< may be none
        std::vector<double> light{}; ///< that each pixel of the camera sees; empty: not yet found
    };
    void cast();
    void light(Shown& shown) const;

    SimulatedTable table_;
    SimulatedCamera camera_;
    Board board_;
    StripeSetup stripes_;
    BoardFaults faults_;
    SeededNumbers numbers_;
    std::vector<float> normals_; ///< noise, read from a place of chance on
    glm::dmat4 table_from_prop_{1.0};
    std::set<int> covered_;
    std::vector<Sample> samples_;
    std::list<Shown> shown_; ///< the latest last
};

} // namespace frustumscreen
