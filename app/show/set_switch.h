/// Exchanges the set on show for another one while the exhibit goes on: the render thread's side of library_watch.h.
///
///     taken -> uploaded, some a frame -> the exhibit lets the old one fade out -> exchanged, in the dark -> the old one is
///     released, some a frame -> given back, to be destroyed elsewhere
///
/// Cost     a frame uploads one picture for the table or some titles, or a few megabytes of the first artifact, as of any that
///          comes; what takes longer is done before, on the library's thread (open_set). Both sets are in memory meanwhile (shown_set.h). Another set waits until the one before is released.
/// Threads  the render thread, with the display's context current, also where it is destroyed. Nothing is read or compiled in a
///          frame. What there is to allocate for a set is allocated in the frames of its coming.
/// Errors   a set that cannot be shown after all is given back with its trouble, and what is shown stays.
#pragma once

#include "app/exhibit/exhibit.h"
#include "app/show/artifact_show.h"
#include "app/show/library_watch.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace frustumscreen {

class SetSwitch {
public:
    /// `artifacts`: made for other sets.
    SetSwitch(ArtifactShow& artifacts, std::unique_ptr<LibraryWatch> library)
        : artifacts_(artifacts), library_(std::move(library)) {}

    /// Before the exhibit's step; `state`: of the step before. True: another set is shown now.
    bool step(MonotonicTime now, State state, Exhibit& exhibit);
    /// After it.
    void report(MonotonicTime now, State state);

    [[nodiscard]] const SharedSetStatus& status() const { return status_; }
    /// At the latest step the library's thread was overdue. That is no reason to end a picture that is well.
    [[nodiscard]] bool library_hangs() const { return library_hangs_; }

private:
    /// Of words and small pictures in a frame: a picture for the table or some titles. Their mip levels are made at upload, which
    /// takes longer than the upload itself.
    static constexpr std::uint64_t frame_bytes = std::uint64_t{256} << 10U;

    void release_the_old();
    void take_the_new(Exhibit& exhibit);
    /// Which of its artifacts is shown first: the one that the visitor sees, if it has that. None: it can show none.
    [[nodiscard]] std::optional<std::size_t> goal(State state, const Exhibit& exhibit) const;
    void bring(State state, Exhibit& exhibit);
    void give_up(const std::string& trouble, Exhibit& exhibit);

    ArtifactShow& artifacts_;
    std::unique_ptr<LibraryWatch> library_;
    std::unique_ptr<ShownSet> coming_, leaving_;
    SharedSetStatus status_;
    bool library_hangs_ = false;
};

} // namespace frustumscreen
