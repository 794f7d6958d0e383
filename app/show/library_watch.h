/// Looks for another installed set of packs, opens it beside the exhibit, and keeps the verdict on the one that is shown.
///
///     set.txt -> SetTrial -> open_set -> take -> (SetSwitch shows it) -> report -> SetTrial -> verdict.json
///
/// Looks    at set.txt a few times a second: a rename makes it another file.
/// Bad      a set of which a pack cannot be opened is not shown at all where there is another to go back to.
/// Threads  one of its own, of low priority, which alone reads and writes files. The render thread calls all of the below; none
///          waits. Where it is destroyed, it waits for the pack that is being opened.
/// Errors   none: what goes wrong stands in the status, and what is shown stays. What could not be read or written is tried again.
#pragma once

#include "app/show/library_files.h"
#include "app/show/shown_set.h"
#include "app/status/set_status.h"
#include "firmware_host/base/heartbeat.h"
#include "firmware_host/base/latest.h"

#include <atomic>
#include <memory>
#include <thread>

namespace frustumscreen {

/// What the render thread shows.
struct ShownReport {
    MonotonicTime now;
    std::uint64_t number = 0; ///< of the set
    bool shows_nothing = false;
    PacksLeftOut left_out;
};

class LibraryWatch {
public:
    struct SetUp {
        std::filesystem::path library;
        SetOptions options;
        ExpectedFrames frames;
        LibraryStart start;
        std::uint64_t shown = 0; ///< number of the set that the exhibit began with
        Nanoseconds between_looks = std::chrono::milliseconds(250);
        Nanoseconds between_tries = std::chrono::seconds(5); ///< of what could not be read or written
    };
    /// `settings` outlive it.
    LibraryWatch(const Settings& settings, SetUp set_up);
    ~LibraryWatch();
    LibraryWatch(const LibraryWatch&) = delete;
    LibraryWatch& operator=(const LibraryWatch&) = delete;

    /// A set to be shown, of which nothing is in the store; none: there is no other.
    [[nodiscard]] std::unique_ptr<ShownSet> take();
    /// Takes a set away of which nothing is in the store any more, to be destroyed; one with a `trouble` is bad. False: not now.
    [[nodiscard]] bool give_back(std::unique_ptr<ShownSet>& set);
    /// At least once a second.
    void report(const ShownReport& report) { static_cast<void>(shown_.try_put(report)); }
    /// False: there is no news.
    [[nodiscard]] bool news(SharedSetStatus& status) { return status_.try_take(status); }
    [[nodiscard]] MonotonicTime alive_until() const { return heartbeat_.promised_until(); }

private:
    void work(const std::stop_token& stop);
    void take_what_comes();
    void refuse(const ShownSet& gone);
    void look();
    void keep();
    void follow_target(const std::stop_token& stop);
    void offer(const InstalledSet& set, const std::stop_token& stop);
    void look_at_keys();
    void post();

    const Settings& settings_;
    SetUp set_up_;
    std::optional<SetTrial> trial_;  ///< none: no set was ever installed
    std::string trouble_;            ///< with set.txt: it is read again
    std::string verdict_trouble_;    ///< it is written again
    std::optional<FileStamp> stamp_; ///< of the set.txt that was read, or could not be
    std::optional<SetVerdict> kept_; ///< as it was written, or could not be
    MonotonicTime read_again_, keep_again_;
    std::uint64_t offered_ = 0;           ///< number of the latest set that was offered, or the first
    std::optional<std::uint64_t> failed_; ///< the latest that could not be opened
    InstalledSet offered_set_, shown_set_;
    std::uint64_t on_show_ = 0; ///< as it was reported
    std::string of_ended_keys_;
    std::optional<std::pair<std::uint64_t, std::optional<FileStamp>>> keys_of_; ///< that it was looked up for
    MonotonicTime keys_again_;
    std::optional<SetStatus> posted_;

    Latest<ShownReport> shown_;
    Latest<SharedSetStatus> status_;
    std::atomic<ShownSet*> coming_{nullptr}; ///< this and `gone_` are owned by who takes them out
    std::atomic<ShownSet*> gone_{nullptr};
    Heartbeat heartbeat_;
    std::jthread thread_; ///< last: it uses the others
};

} // namespace frustumscreen
