/// Exchanges the shown set for another one while the exhibit runs: the render thread's side of library_watch.h.
///
///     taken -> uploaded, a part each frame -> the exhibit fades the old one out -> exchanged, in the dark
///     -> the old one is released, a part each frame -> given back, to be destroyed on another thread
///
/// Cost     a frame uploads one table picture or some titles, or a few megabytes of the first artifact, as for any
///          artifact; slower work is done before, on the library's thread (open_set). Both sets are in memory
///          meanwhile (shown_set.h). Another set waits until the previous one is released.
/// Threads  the render thread, with the display's context current, including destruction. Nothing is read or compiled
///          in a frame. Memory for a set is allocated in the frames before it is shown.
/// Errors   a set that cannot be shown is given back with its trouble, and the shown set stays.
#pragma once

#include "app/exhibit/exhibit.h"
#include "app/show/artifact_show.h"
#include "app/show/library_watch.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace frustumscreen::show {

class SetSwitch {
public:
    /// `artifacts`: created with `other_sets`.
    SetSwitch(ArtifactShow& artifacts, std::unique_ptr<LibraryWatch> library)
        : artifacts_(artifacts), library_(std::move(library)) {}

    /// Call before the exhibit's step; `state`: of the previous step. True: another set is shown from this step on.
    bool step(MonotonicTime now, exhibit::State state, exhibit::Exhibit& exhibit);
    /// Call after the exhibit's step.
    void report(MonotonicTime now, exhibit::State state);

    [[nodiscard]] const status::SharedSetStatus& status() const { return status_; }
    /// True if, at the latest step, the library's thread was overdue. That is no reason to end a good picture.
    [[nodiscard]] bool library_hangs() const { return library_hangs_; }

private:
    /// Bytes of words and small pictures in a frame: one table picture or some titles. Making their mip levels at
    /// upload takes longer than the upload itself.
    static constexpr std::uint64_t frame_bytes = std::uint64_t{256} << 10U;

    void release_the_old();
    void take_the_new(exhibit::Exhibit& exhibit);
    /// The artifact to show first: the one on show, if the new set has it. None: the set can show no artifact.
    [[nodiscard]] std::optional<std::size_t> goal(exhibit::State state,
                                                  const exhibit::Exhibit& exhibit) const;
    void bring(exhibit::State state, exhibit::Exhibit& exhibit);
    void give_up(const std::string& trouble, exhibit::Exhibit& exhibit);

    ArtifactShow& artifacts_;
    std::unique_ptr<LibraryWatch> library_;
    std::unique_ptr<ShownSet> coming_, leaving_;
    status::SharedSetStatus status_;
    bool library_hangs_ = false;
};

} // namespace frustumscreen::show
