#include "app/bench/guidance/visitor.h"

#include "app/bench/guidance/paper_rule.h"
#include "app/bench/truth/seeded_situations.h"
#include "app/guidance/guide.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace frustumscreen {

namespace {

constexpr double step_s = 0.05;
constexpr double patience_s = std::chrono::duration<double>(Guide::patience).count();
constexpr double sees_success_after_s = 0.5;
constexpr double misunderstands = 0.10;
constexpr double overlooks = 0.15;
constexpr double overlooks_for_s = 2.0;
constexpr double slide_m_s = 0.25;
constexpr double turn_rad_s = 2.0;
constexpr double walk_m_s = 0.8;
constexpr double stand_up_s = 1.0;

/// A movement that is under way: from one situation to another in a time.
struct Motion {
    GuidedSituation from;
    GuidedSituation to;
    double lasts_s = 0.0;
    double gone_s = 0.0;

    [[nodiscard]] GuidedSituation now() const {
        const double share = lasts_s > 0.0 ? std::min(1.0, gone_s / lasts_s) : 1.0;
        const double eased = share * share * (3.0 - 2.0 * share);
        GuidedSituation situation;
        situation.table_from_prop.rotation =
            glm::slerp(from.table_from_prop.rotation, to.table_from_prop.rotation, eased);
        situation.table_from_prop.translation =
            glm::mix(from.table_from_prop.translation, to.table_from_prop.translation, eased);
        const double azimuth = std::atan2(from.eye_m.y, from.eye_m.x);
        const double turn =
            std::remainder(std::atan2(to.eye_m.y, to.eye_m.x) - azimuth, 2.0 * std::numbers::pi);
        const double radius =
            glm::mix(glm::length(glm::dvec2(from.eye_m)), glm::length(glm::dvec2(to.eye_m)), eased);
        const double at = azimuth + eased * turn;
        situation.eye_m = {radius * std::cos(at), radius * std::sin(at),
                           glm::mix(from.eye_m.z, to.eye_m.z, eased)};
        return situation;
    }
    [[nodiscard]] bool done() const { return gone_s >= lasts_s; }
};

double time_for(const Move& move, const GuidedSituation& from, const GuidedSituation& to) {
    switch (move.action) {
    case Action::SetDown:
    case Action::Upright:
        return stand_up_s;
    case Action::ComeRound: {
        const double angle =
            std::remainder(std::atan2(to.eye_m.y, to.eye_m.x) - std::atan2(from.eye_m.y, from.eye_m.x),
                           2.0 * std::numbers::pi);
        return std::abs(angle) * glm::length(glm::dvec2(from.eye_m)) / walk_m_s;
    }
    case Action::Turn:
        return 0.2 + std::abs(move.turn_rad) / turn_rad_s;
    default:
        return 0.2 + glm::length(move.by_m) / slide_m_s;
    }
}

class Visitor {
public:
    Visitor(const GuidanceSetup& setup, Adviser adviser, std::uint64_t seed)
        : setup_(setup), reader_(setup), advisor_(setup), adviser_(adviser), seeded_(seed),
          situation_(seeded_situation(setup, seeded_)) {
        constexpr double table_height_m = 0.8;
        const double azimuth = seeded_.between(-std::numbers::pi, std::numbers::pi);
        const double away_m = seeded_.between(0.5, 0.9);
        situation_.eye_m = {away_m * std::cos(azimuth), away_m * std::sin(azimuth),
                            std::max(0.2, seeded_.between(0.9, 1.9) - table_height_m)};
        next_play_s_ = 1.0;
    }

    VisitResult visit(double seconds) {
        VisitResult result;
        result.seconds = seconds;
        int whole = 0;
        int steps = 0;
        for (now_s_ = 0.0; now_s_ < seconds; now_s_ += step_s, ++steps) {
            const bool valid = reader_.valid(situation_);
            whole += valid ? 1 : 0;
            valid ? be_content(result) : mend(result);
            move_on();
        }
        if (lost_since_s_ && now_s_ - *lost_since_s_ > patience_s) {
            result.mended_s.push_back(now_s_ - *lost_since_s_); // at least
        }
        result.whole_share = static_cast<double>(whole) / steps;
        return result;
    }

private:
    void begin(const Move& move, const Execution& execution) {
        const GuidedSituation to = after(move, setup_, situation_, execution);
        before_ = situation_;
        motion_ = Motion{situation_, to, time_for(move, situation_, to)};
    }

    void move_on() {
        if (motion_) {
            motion_->gone_s += step_s;
            situation_ = motion_->now();
            if (motion_->done()) {
                motion_.reset();
            }
        }
    }

    /// The picture is whole: ends what was done to mend it, and plays after a while.
    void be_content(VisitResult& result) {
        if (lost_since_s_) {
            if (now_s_ - *lost_since_s_ > patience_s) {
                result.mended_s.push_back(now_s_ - *lost_since_s_);
                next_play_s_ = now_s_ + seeded_.between(2.0, 5.0);
            }
            lost_since_s_.reset();
            acts_at_s_.reset();
            whole_since_s_ = now_s_;
        }
        if (mending_ && motion_ && now_s_ - whole_since_s_ > sees_success_after_s) {
            motion_.reset();
        }
        if (!motion_) {
            mending_ = false;
            if (now_s_ >= next_play_s_) {
                play();
                next_play_s_ = now_s_ + seeded_.between(2.0, 5.0);
            }
        }
    }

    void play() {
        Move move{Action::Turn};
        move.turn_rad = 0.9 * seeded_.normal();
        const double what = seeded_.between(0.0, 1.0);
        if (what < 0.25) {
            const double azimuth = seeded_.between(-std::numbers::pi, std::numbers::pi);
            move = {Action::Slide};
            move.by_m = seeded_.between(0.01, 0.08) * glm::dvec3(std::cos(azimuth), std::sin(azimuth), 0.0);
        } else if (what < 0.30) {
            move = {Action::Raise};
            move.by_m.z = seeded_.between(0.03, 0.15);
        }
        begin(move, {});
        if (setup_.in_hand && what > 0.8) {
            const glm::dvec3 axis(seeded_.normal(), seeded_.normal(), seeded_.normal());
            motion_->to.table_from_prop.rotation =
                glm::angleAxis(seeded_.between(0.1, 0.7), glm::normalize(axis)) *
                motion_->to.table_from_prop.rotation;
        }
        mending_ = false;
    }

    void mend(VisitResult& result) {
        if (!lost_since_s_) {
            lost_since_s_ = now_s_;
        }
        if (motion_ && !mending_) {
            return; // the movement that lost the picture ends first
        }
        if (motion_) {
            return;
        }
        if (!acts_at_s_) {
            const double shown_s =
                std::max(now_s_, *lost_since_s_ + (adviser_ == Adviser::None ? 0.0 : patience_s));
            acts_at_s_ =
                shown_s + seeded_.between(0.3, 1.5) + (seeded_.happens(overlooks) ? overlooks_for_s : 0.0);
            return;
        }
        if (now_s_ < *acts_at_s_) {
            return;
        }
        acts_at_s_.reset();
        mending_ = true;
        const std::optional<Move> advice = advised();
        if (advice && advice->action != Action::Wait) {
            ++result.advices;
            follow(*advice);
        } else {
            try_something();
        }
    }

    [[nodiscard]] std::optional<Move> advised() {
        if (adviser_ == Adviser::None) {
            return std::nullopt;
        }
        if (adviser_ == Adviser::Paper) {
            return paper_advice(reader_, situation_);
        }
        const std::optional<Advice> advice = advisor_.advise(situation_);
        return advice ? std::optional(advice->move) : std::nullopt;
    }

    void follow(Move move) {
        if (seeded_.happens(misunderstands)) { // does the opposite
            move.by_m = -move.by_m;
            move.turn_rad = -move.turn_rad;
        }
        begin(move, seeded_person(move, setup_, seeded_));
    }

    /// Half of the time people undo what lost the picture; a prop that leans most would stand up.
    void try_something() {
        const bool leans = tilt_rad(situation_.table_from_prop) > 0.2;
        if (leans && !setup_.in_hand && seeded_.happens(0.7)) {
            begin({Action::Upright}, {});
        } else if (before_ && seeded_.happens(0.5)) {
            const GuidedSituation back{before_->table_from_prop, situation_.eye_m};
            motion_ = Motion{situation_, back, 1.0};
            before_.reset();
        } else {
            Move move{Action::Slide};
            const double azimuth = seeded_.between(-std::numbers::pi, std::numbers::pi);
            move.by_m = seeded_.between(0.04, 0.15) * glm::dvec3(std::cos(azimuth), std::sin(azimuth), 0.0);
            if (seeded_.happens(0.4)) {
                move = {Action::Turn};
                move.turn_rad = 0.8 * seeded_.normal();
            }
            begin(move, {});
        }
    }

    const GuidanceSetup& setup_;
    FaceReader reader_;
    Advisor advisor_;
    Adviser adviser_;
    Seeded seeded_;
    GuidedSituation situation_;
    std::optional<GuidedSituation> before_; ///< the latest movement
    std::optional<Motion> motion_;
    bool mending_ = false; ///< the movement is there to mend the picture
    double now_s_ = 0.0;
    double next_play_s_ = 0.0;
    double whole_since_s_ = 0.0;
    std::optional<double> lost_since_s_;
    std::optional<double> acts_at_s_;
};

} // namespace

std::string_view name_of(Adviser adviser) {
    constexpr std::array<std::string_view, 3> names{"the exhibit's advice", "the paper's advice",
                                                    "no advice"};
    return names.at(static_cast<std::size_t>(adviser));
}

VisitResult simulate_visit(const GuidanceSetup& setup, Adviser adviser, std::uint64_t seed, double seconds) {
    return Visitor(setup, adviser, seed).visit(seconds);
}

} // namespace frustumscreen
