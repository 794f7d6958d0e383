#include "app/show/staff_show.h"

#include <chrono>

namespace frustumscreen::show {

StaffShow::StaffShow(const settings::Settings& settings, typography::Typesetter typesetter,
                     std::unique_ptr<PatternShow> pattern)
    : settings_(settings), typesetter_(std::move(typesetter)), pattern_(std::move(pattern)) {}

Result<std::unique_ptr<StaffShow>> StaffShow::create(const settings::Settings& settings, bool speaks,
                                                     std::string driver, exhibit::State before) {
    TRY(typography::Typesetter typesetter, typography::Typesetter::open());
    TRY(std::unique_ptr<PatternShow> pattern, PatternShow::create(settings));
    std::unique_ptr<StaffShow> show(new StaffShow(settings, std::move(typesetter), std::move(pattern)));
    show->driver_ = std::move(driver);
    show->before_ = before;
    show->facts_.speaks = speaks;
    return show;
}

void StaffShow::tell(const RunStatus& status, double gain_db) {
    const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    StaffFacts facts = staff_facts(status, settings_, driver_, before_, now);
    facts.speaks = facts_.speaks;
    facts.settings_gain_db = gain_db;
    facts.prop = facts_.prop;
    facts.head = facts_.head;
    facts.copy = facts_.copy;
    if (facts != facts_) {
        facts_ = std::move(facts);
        drawn_.reset();
    }
    pattern_->tell(status);
}

void StaffShow::set_copy(const exhibit::CopyState& copy) {
    if (facts_.copy != copy) {
        facts_.copy = copy;
        if (drawn_ && drawn_->page == exhibit::StaffPage::Copy) {
            drawn_.reset();
        }
    }
}

void StaffShow::show(MonotonicTime now, const exhibit::StaffView& view, const tracking::TrackerSignal& prop,
                     const tracking::TrackerSignal& head) {
    if (view.page == exhibit::StaffPage::Tracker &&
        (now - signals_at_ >= between_signals || drawn_ != view) &&
        (facts_.prop != prop || facts_.head != head)) {
        facts_.prop = prop;
        facts_.head = head;
        signals_at_ = now;
        drawn_.reset();
    }
    if (drawn_ == view) {
        return;
    }
    const typography::PatternScene& scene = pattern_->scene();
    if (const std::pair of(view.page, view.light); background_of_ != of) {
        background_ = staff_background(view, scene, typesetter_);
        background_of_ = of;
    }
    pattern_->set_picture(staff_picture(view, facts_, scene, background_, typesetter_),
                          view.page == exhibit::StaffPage::Place);
    drawn_ = view;
}

} // namespace frustumscreen::show
