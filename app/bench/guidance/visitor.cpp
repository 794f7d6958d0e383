#include "app/bench/guidance/visitor.h"

#include "app/bench/guidance/motion.h"
#include "app/bench/guidance/perfect_advice.h"
#include "app/bench/truth/seeded_situations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace frustumscreen::bench {

namespace {

constexpr double step_s = 1.0 / 60.0; // the exhibit's step
constexpr double debounce_s = std::chrono::duration<double>(guidance::Guide::debounce).count();
constexpr double sees_success_after_s = 0.5;
constexpr double min_reaction_s = 0.3;
constexpr double longest_reaction_s = 1.5;
constexpr double misunderstands = 0.10;
constexpr double overlooks = 0.15;
constexpr double overlooks_for_s = 2.0;
constexpr double visibly_darker = 1.1;

class Visitor {
public:
    Visitor(const guidance::GuidanceSetup& setup, Adviser adviser, std::uint64_t seed)
        : setup_(setup), reader_(setup), sign_(setup, adviser), adviser_(adviser), plays_(seed),
          reacts_(~seed), tracked_state_(seeded_situation(setup, plays_)) {
        constexpr double table_height_m = 0.8;
        const double azimuth = plays_.between(-std::numbers::pi, std::numbers::pi);
        const double away_m = plays_.between(0.5, 0.9);
        tracked_state_.eye_m = {away_m * std::cos(azimuth), away_m * std::sin(azimuth),
                                std::max(0.2, plays_.between(0.9, 1.9) - table_height_m)};
        next_play_s_ = 1.0;
    }

    VisitResult visit(double seconds) {
        VisitResult result;
        result.seconds = seconds;
        int whole = 0;
        int steps = 0;
        for (now_s_ = 0.0; now_s_ < seconds; now_s_ += step_s, ++steps) {
            sign_.step(now_s_, tracked_state_);
            if (reader_.whole(tracked_state_)) {
                ++whole;
                be_content(result);
            } else {
                mend(result);
                result.dark_s.at(static_cast<std::size_t>(doing())) += step_s;
            }
            move_on();
        }
        if (lost_since_s_ && now_s_ - *lost_since_s_ > debounce_s) {
            result.restored_s.push_back(now_s_ - *lost_since_s_); // a lower bound, as the visit ends
        }
        result.whole_share = static_cast<double>(whole) / steps;
        return result;
    }

private:
    /// A movement, its reason, and the visitor's view of its success.
    struct Doing {
        Motion motion;
        guidance::Move asked; ///< Wait: the visitor's own idea
        bool mends = false;   ///< meant to mend the picture
        bool wrong = false;   ///< not the advised move
        bool doubted = false; ///< the visitor has seen that it does not help
        double dark_px = 0.0; ///< unlit pixels at its start
    };

    [[nodiscard]] DarkWhile doing() const {
        if (doing_) {
            return !doing_->mends  ? DarkWhile::Playing
                   : doing_->wrong ? DarkWhile::GoingWrong
                                   : DarkWhile::Mending;
        }
        if (!acts_at_s_) {
            return DarkWhile::Waiting;
        }
        return now_s_ < noticed_at_s_ ? DarkWhile::Overlooking : DarkWhile::Reacting;
    }

    void begin(const guidance::Move& move, const guidance::Execution& execution) {
        const guidance::GuidedState to = guidance::after(move, setup_, tracked_state_, execution);
        before_ = tracked_state_;
        begin(to, time_for_s(move, tracked_state_, to));
    }

    void begin(const guidance::GuidedState& to, double lasts_s) {
        doing_ = Doing();
        doing_->motion = {.from = tracked_state_, .to = to, .lasts_s = lasts_s};
        doing_->dark_px = reader_.lost_px(tracked_state_);
    }

    void move_on() {
        if (doing_) {
            doing_->motion.gone_s += step_s;
            tracked_state_ = doing_->motion.now();
            if (doing_->motion.done()) {
                doing_.reset();
            }
        }
    }

    /// The picture is whole: ends a mending movement, and starts to play after a while.
    void be_content(VisitResult& result) {
        if (lost_since_s_) {
            if (now_s_ - *lost_since_s_ > debounce_s) {
                result.restored_s.push_back(now_s_ - *lost_since_s_);
                next_play_s_ = now_s_ + plays_.between(2.0, 5.0);
            }
            lost_since_s_.reset();
            acts_at_s_.reset();
            whole_since_s_ = now_s_;
        }
        if (doing_ && doing_->mends && now_s_ - whole_since_s_ > sees_success_after_s) {
            doing_.reset();
        }
        if (!doing_ && now_s_ >= next_play_s_) {
            play();
            next_play_s_ = now_s_ + plays_.between(2.0, 5.0);
        }
    }

    void play() {
        guidance::Move move{guidance::Action::Turn};
        move.turn_rad = 0.9 * plays_.normal();
        const double what = plays_.between(0.0, 1.0);
        if (what < 0.25) {
            const double azimuth = plays_.between(-std::numbers::pi, std::numbers::pi);
            move = {guidance::Action::Slide};
            move.by_m = plays_.between(0.01, 0.08) * glm::dvec3(std::cos(azimuth), std::sin(azimuth), 0.0);
        } else if (what < 0.30) {
            move = {guidance::Action::Raise};
            move.by_m.z = plays_.between(0.03, 0.15);
        }
        begin(move, {});
        if (setup_.in_hand && what > 0.8) {
            const glm::dvec3 axis(plays_.normal(), plays_.normal(), plays_.normal());
            doing_->motion.to.table_from_prop.rotation =
                glm::angleAxis(plays_.between(0.1, 0.7), glm::normalize(axis)) *
                doing_->motion.to.table_from_prop.rotation;
        }
    }

    void mend(VisitResult& result) {
        if (!lost_since_s_) {
            lost_since_s_ = now_s_;
            read_since_s_.reset();
            // A visitor who is following a sign already looks at it.
            attends_ = doing_ && doing_->mends;
            acted_ = false;
            ++result.losses;
        }
        adviser_ == Adviser::None || adviser_ == Adviser::Perfect ? look_at_picture() : read_sign();
        const bool plays = doing_ && !doing_->mends; // the movement that lost the picture ends first
        if (!acts_at_s_ || now_s_ < *acts_at_s_ || plays) {
            return;
        }
        acts_at_s_.reset();
        act(result);
    }

    /// Starts the visitor's reaction time.
    void react() {
        const double reaction_s = reacts_.between(min_reaction_s, longest_reaction_s);
        const bool misses = !attends_ && adviser_ != Adviser::Perfect && reacts_.happens(overlooks);
        noticed_at_s_ = now_s_ + (misses ? overlooks_for_s : 0.0);
        acts_at_s_ = noticed_at_s_ + reaction_s;
        attends_ = true;
    }

    /// Reacts to a new sign, even during a movement, and to the present one if the movement has ended without success.
    void read_sign() {
        const std::optional<SignOnTable>& sign = sign_.shown();
        if (!sign) {
            acts_at_s_.reset();
            read_since_s_.reset();
            return;
        }
        if (!read_since_s_ || *read_since_s_ != sign->since_s) {
            read_since_s_ = sign->since_s;
            acts_at_s_.reset();
            const bool follows = doing_ && doing_->mends && guidance::alike(doing_->asked, sign->move);
            if (!follows) {
                react();
            }
        } else if (!acts_at_s_ && (!doing_ || finds_wrong())) {
            react();
        }
    }

    /// As read_sign, without a sign. A visitor with perfect advice needs one reaction time for a whole sequence.
    void look_at_picture() {
        if (acts_at_s_) {
            return;
        }
        if (adviser_ == Adviser::Perfect && acted_) {
            if (!doing_) {
                acts_at_s_ = now_s_;
            }
        } else if (!acted_ || !doing_ || finds_wrong()) {
            react();
            acted_ = true;
        }
    }

    /// True once for each movement that does not help: it leads away from the advice, or more becomes dark.
    [[nodiscard]] bool finds_wrong() {
        if (!doing_->mends || doing_->doubted) {
            return false;
        }
        const bool goes_away =
            doing_->wrong && !guidance::GivenAdvice{doing_->asked, doing_->motion.from}.holds(tracked_state_);
        const bool darkens = doing_->asked.action == guidance::Action::Wait &&
                             reader_.lost_px(tracked_state_) > visibly_darker * doing_->dark_px;
        doing_->doubted = goes_away || darkens;
        return doing_->doubted;
    }

    void act(VisitResult& result) {
        if (adviser_ == Adviser::Perfect) {
            const std::optional<guidance::Move> move = perfect_advice(reader_, tracked_state_);
            begin(move.value_or(guidance::Move{}), {});
            ++result.advices;
        } else if (sign_.shown() && sign_.shown()->move.action != guidance::Action::Wait) {
            follow(sign_.shown()->move);
            ++result.advices;
        } else {
            try_something();
        }
        doing_->mends = true;
    }

    void follow(const guidance::Move& asked) {
        const bool wrong = reacts_.happens(misunderstands);
        const guidance::Move move = wrong ? instead_of(asked) : asked;
        begin(move, seeded_person(move, setup_, reacts_));
        doing_->asked = asked;
        doing_->wrong = wrong;
    }

    /// The opposite move; a slide in any direction if there is no opposite.
    [[nodiscard]] guidance::Move instead_of(guidance::Move move) {
        if (move.action == guidance::Action::Upright || move.action == guidance::Action::SetDown) {
            return some_way();
        }
        move.by_m = -move.by_m;
        move.turn_rad = -move.turn_rad;
        move.side = static_cast<guidance::Side>((static_cast<int>(move.side) + 2) % 4);
        return move;
    }

    [[nodiscard]] guidance::Move some_way() {
        guidance::Move move{guidance::Action::Slide};
        const double azimuth = reacts_.between(-std::numbers::pi, std::numbers::pi);
        move.by_m = reacts_.between(0.04, 0.15) * glm::dvec3(std::cos(azimuth), std::sin(azimuth), 0.0);
        return move;
    }

    /// Half of the time people undo the movement that lost the picture; a leaning prop is usually set upright.
    void try_something() {
        const bool leans = guidance::tilt_rad(tracked_state_.table_from_prop) > 0.2;
        if (leans && !setup_.in_hand && reacts_.happens(0.7)) {
            begin({guidance::Action::Upright}, {});
        } else if (before_ && reacts_.happens(0.5)) {
            constexpr double undone_in_s = 1.0;
            begin(guidance::GuidedState{before_->table_from_prop, tracked_state_.eye_m}, undone_in_s);
            before_.reset();
        } else {
            guidance::Move move = some_way();
            if (reacts_.happens(0.4)) {
                move = {guidance::Action::Turn};
                move.turn_rad = 0.8 * reacts_.normal();
            }
            begin(move, {});
        }
    }

    const guidance::GuidanceSetup& setup_;
    guidance::FaceReader reader_;
    ShownSign sign_;
    Adviser adviser_;
    Seeded plays_;  ///< equal for all advisers
    Seeded reacts_; ///< reaction times, misunderstandings, sloppiness
    guidance::GuidedState tracked_state_;
    std::optional<guidance::GuidedState> before_; ///< before the latest movement
    std::optional<Doing> doing_;
    double now_s_ = 0.0;
    double next_play_s_ = 0.0;
    double whole_since_s_ = 0.0;
    std::optional<double> lost_since_s_;
    bool attends_ = false;               ///< looks at the sign, or at the dark part
    bool acted_ = false;                 ///< has reacted, or is about to, since the loss of the picture
    std::optional<double> read_since_s_; ///< time at which the sign that was read had appeared
    double noticed_at_s_ = 0.0;
    std::optional<double> acts_at_s_;
};

} // namespace

std::string_view name_of(Adviser adviser) {
    constexpr std::array<std::string_view, 4> names{"the exhibit's advice", "the paper's advice", "no advice",
                                                    "perfect advice (floor)"};
    return names.at(static_cast<std::size_t>(adviser));
}

VisitResult simulate_visit(const guidance::GuidanceSetup& setup, Adviser adviser, std::uint64_t seed,
                           double seconds) {
    return Visitor(setup, adviser, seed).visit(seconds);
}

} // namespace frustumscreen::bench
