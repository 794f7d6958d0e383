/// Watches for another installed set of packs, opens it while the exhibit runs, and keeps the verdict on the shown
/// one.
///
///     set.txt -> SetTrial -> open_set -> take -> (SetSwitch shows it) -> report -> SetTrial -> verdict.json
///
/// Polls    set.txt a few times a second: a rename changes its identity.
/// Bad      a set with a pack that cannot be opened is not shown if there is another set to return to.
/// Threads  its own, of low priority, which alone reads and writes files. The render thread calls everything below
///          and never waits, except in the destructor, which waits for the pack that is being opened.
/// Errors   none: problems are in the status, and the shown set stays. Failed reads and writes are repeated.
#pragma once

#include "app/show/library_files.h"
#include "app/show/shown_set.h"
#include "app/status/set_status.h"
#include "firmware_host/base/heartbeat.h"
#include "firmware_host/base/latest.h"

#include <atomic>
#include <memory>
#include <thread>

namespace frustumscreen::show {

/// The render thread's report on the shown set, for the verdict.
struct ShownReport {
    MonotonicTime now;
    std::uint64_t number = 0; ///< of the set
    bool shows_nothing = false;
    library::UnshownPacks left_out;
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
        Nanoseconds between_tries = std::chrono::seconds(5); ///< after a failed read or write
    };
    /// `settings` must outlive this object.
    LibraryWatch(const settings::Settings& settings, SetUp set_up);
    ~LibraryWatch();
    LibraryWatch(const LibraryWatch&) = delete;
    LibraryWatch& operator=(const LibraryWatch&) = delete;

    /// Returns a set to show, with nothing in the store yet; null: there is none.
    [[nodiscard]] std::unique_ptr<ShownSet> take();
    /// Takes over a set that has nothing left in the store, to destroy it; a set with a `trouble` is bad. False: not
    /// possible yet.
    [[nodiscard]] bool give_back(std::unique_ptr<ShownSet>& set);
    /// Call at least once a second.
    void report(const ShownReport& report) { static_cast<void>(shown_.try_put(report)); }
    /// Takes the status if it is new; false: it is not.
    [[nodiscard]] bool news(status::SharedSetStatus& status) { return status_.try_take(status); }
    [[nodiscard]] MonotonicTime alive_until() const { return heartbeat_.promised_until(); }

private:
    void work(const std::stop_token& stop);
    void take_what_comes();
    void refuse(const ShownSet& gone);
    void look();
    void keep();
    void follow_target(const std::stop_token& stop);
    void offer(const library::InstalledSet& set, const std::stop_token& stop);
    void look_at_keys();
    void post();

    const settings::Settings& settings_;
    SetUp set_up_;
    std::optional<SetTrial> trial_;           ///< none: no set was ever installed
    std::string trouble_;                     ///< with set.txt, which is read again
    std::string verdict_trouble_;             ///< with the verdict, which is written again
    std::optional<FileStamp> stamp_;          ///< of the set.txt read last, or not readable
    std::optional<library::SetVerdict> kept_; ///< as written last, or not writable
    MonotonicTime read_again_, keep_again_;
    std::uint64_t offered_ = 0;           ///< number of the latest set offered, or of the first set
    std::optional<std::uint64_t> failed_; ///< the latest set that could not be opened
    library::InstalledSet offered_set_, shown_set_;
    std::uint64_t on_show_ = 0; ///< as reported
    std::string of_ended_keys_;
    /// The set and the set.txt whose keys were checked last.
    std::optional<std::pair<std::uint64_t, std::optional<FileStamp>>> keys_of_;
    MonotonicTime keys_again_;
    std::optional<status::SetStatus> posted_;

    Latest<ShownReport> shown_;
    Latest<status::SharedSetStatus> status_;
    std::atomic<ShownSet*> coming_{nullptr}; ///< `coming_`, `gone_`: owned by the thread that takes them
    std::atomic<ShownSet*> gone_{nullptr};
    Heartbeat heartbeat_;
    std::jthread thread_; ///< last: it uses the others
};

} // namespace frustumscreen::show
