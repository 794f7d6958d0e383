/// The artifacts that are in memory: loaded ahead of the visitor, in pieces, within a budget.
///
///     wanted -> next_step (residency.h) -> ArtifactReader -> PreparedArtifact -> LevelUpload, some bytes a frame -> ready
///
/// Budget   counts what an artifact takes of the GPU's memory and of main memory from the moment that it is prepared.
///          While one is read, its file's parts and one level of it come on top.
/// Threads  the render thread, with the display's context current, also where it is destroyed; the reader is a thread of
///          its own, there only where there is more than one artifact. A step reads no file and waits for nothing.
/// Errors   an artifact that turns out bad is left out, with a line on standard error; the others stay.
#pragma once

#include "app/exhibit/artifact_state.h"
#include "app/render/gpu_store.h"
#include "app/show/artifact_reader.h"
#include "app/show/prepared_artifact.h"
#include "app/show/residency.h"
#include "app/show/run_report.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen {

struct ResidentsSetUp {
    std::vector<KnownArtifact> artifacts; ///< at least one
    std::string technique = "auto";
    double deadline_ms = 16.0;
    std::uint64_t budget_bytes = 0;
    bool waits = false; ///< a step ends when all is there, so that a run of simulated time is repeatable
    std::string_view program = "frustumscreen"; ///< whose lines on standard error they are
    std::vector<PackLeftOut> left_out = {};     ///< before
};

class Residents {
public:
    /// Bytes that one frame uploads of what the visitor waits for, and of what is loaded ahead.
    static constexpr std::uint64_t urgent_bytes = std::uint64_t{4} << 20U;
    static constexpr std::uint64_t early_bytes = std::uint64_t{1} << 20U;

    /// `first`: of the first artifact, uploaded at once.
    [[nodiscard]] static Result<std::unique_ptr<Residents>> create(ResidentsSetUp set_up,
                                                                   PreparedArtifact first, GpuStore& store);
    ~Residents();
    Residents(const Residents&) = delete;
    Residents& operator=(const Residents&) = delete;

    /// From now on the others may come. `cost`: of frames on this GPU; `prop`, `view`: what a rung's time is expected for,
    /// `eye_m` its eye.
    void start(const RungCost& cost, const PropShape& prop, const PlanView& view, const glm::dvec3& eye_m);
    /// Once a frame. `wanted`: most urgent first.
    void step(GpuStore& store, std::size_t shown, std::span<const std::size_t> wanted);

    /// Null if it is not ready.
    [[nodiscard]] RunLevels* find(std::size_t artifact);
    [[nodiscard]] const RunLevels* find(std::size_t artifact) const;
    [[nodiscard]] double exposure(std::size_t artifact) const;
    /// None if it is not ready, or has no hotspots.
    [[nodiscard]] ArtifactTriangles triangles(std::size_t artifact) const;
    [[nodiscard]] const KnownArtifact& known(std::size_t artifact) const {
        return set_up_.artifacts[artifact];
    }
    [[nodiscard]] std::size_t size() const { return set_up_.artifacts.size(); }
    [[nodiscard]] std::span<const ArtifactState> states() const { return states_; }
    /// With those of before; elements stay where they are, for who reports them on another thread.
    [[nodiscard]] std::span<const PackLeftOut> left_out() const { return left_out_; }

    [[nodiscard]] std::size_t ready() const;      ///< how many artifacts can be drawn at once
    [[nodiscard]] std::uint64_t bytes() const;    ///< of all that is loaded or being uploaded
    [[nodiscard]] std::uint64_t switches() const; ///< of levels, of artifacts here or gone
    [[nodiscard]] std::uint64_t ignored_times() const;

private:
    struct Loaded {
        PreparedArtifact artifact;
        std::vector<LevelUpload> uploads;
        std::size_t uploaded = 0; ///< levels that are in the store
        [[nodiscard]] bool ready() const { return uploaded == uploads.size(); }
    };
    Residents(ResidentsSetUp set_up, PreparedArtifact first);
    void step_once(GpuStore& store, std::size_t shown, std::span<const std::size_t> wanted);
    void receive();
    void keep(std::size_t artifact, PreparedArtifact prepared);
    void upload(GpuStore& store, std::size_t shown, std::span<const std::size_t> wanted);
    [[nodiscard]] Result<void> upload(GpuStore& store, std::size_t artifact, std::uint64_t most_bytes);
    void release(GpuStore& store, std::size_t artifact);
    void leave_out(std::size_t artifact, const std::string& reason);

    ResidentsSetUp set_up_;
    std::vector<std::unique_ptr<Loaded>> loaded_; ///< none: it is not there
    std::vector<ResidentArtifact> records_;
    std::vector<ArtifactState> states_;
    std::vector<PackLeftOut> left_out_;
    std::optional<std::size_t> shown_;
    std::uint64_t shows_ = 0; ///< how often another one was shown
    bool steady_ = false;     ///< nothing was left to do at the latest step
    std::uint64_t past_switches_ = 0, past_ignored_times_ = 0;
    std::unique_ptr<ArtifactReader> reader_; ///< last: its thread uses `set_up_`
};

} // namespace frustumscreen
