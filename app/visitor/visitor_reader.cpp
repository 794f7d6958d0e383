#include "app/visitor/visitor_reader.h"

#include "app/geometry/time_curves.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace frustumscreen::visitor {

namespace {

constexpr double same_head = 0.8;    ///< largest movement of a head between frames, in head widths
constexpr double still_mean_s = 2.0; ///< time constant of the mean position that detects stillness
/// Area that a person hides, in widths of the head.
constexpr double half_body = 1.7;
constexpr double above_middle = 1.2;

glm::dvec3 middle_of_table() {
    return {0.0, 0.0, 0.05};
}

} // namespace

VisitorReader::VisitorReader(VisitorSetUp set_up, std::function<double()> busy)
    : set_up_(std::move(set_up)), pace_(max_share, std::move(busy)) {}

std::span<const tracking::SeenHead> VisitorReader::read(const camera::CameraFrame& frame) {
    heads_.clear();
    if (!pace_.begin(frame.time)) {
        ++counts_.skipped;
        return heads_;
    }
    look(frame);
    pace_.end();
    ++counts_.looked_at;
    return heads_;
}

void VisitorReader::prepare(int width, int height) {
    const int block = block_of(width);
    const geometry::Pinhole whole = set_up_.camera.scaled_to(width, height);
    camera_ = whole;
    camera_.width = width / block;
    camera_.height = height / block;
    for (double* number : {&camera_.fx, &camera_.fy, &camera_.cx, &camera_.cy}) {
        *number /= block;
    }
    background_.emplace(what_pixels_show(set_up_.zone, camera_, set_up_.table_from_camera));
    people_.clear();
}

void VisitorReader::look(const camera::CameraFrame& frame) {
    const geometry::Pinhole& measured = set_up_.camera;
    if (frame.width <= 0 || frame.width * measured.height != frame.height * measured.width) {
        ++counts_.misshapen;
        return;
    }
    shrink(frame, small_);
    if (!background_ || small_.width != camera_.width || small_.height != camera_.height) {
        prepare(frame.width, frame.height);
    }
    const int began = background_->beginnings();
    const std::span<const std::uint8_t> foreground = background_->find(frame.time, small_);
    if (background_->beginnings() != began) {
        people_.clear();
    }
    fitted_.clear();
    for (const HeadOutline& outline : find_head_outlines(foreground, small_.width, small_.height)) {
        if (const auto head = fit_head(outline, camera_, set_up_.table_from_camera, set_up_.zone)) {
            fitted_.push_back(*head);
        }
    }
    follow(frame.time);
    boxes_.clear();
    for (const Person& person : people_) {
        const double width = person.head.width_px;
        const glm::dvec2 at = person.head.pixel;
        const PixelBox box{.left = static_cast<int>(at.x - half_body * width),
                           .top = static_cast<int>(at.y - above_middle * width),
                           .right = static_cast<int>(at.x + half_body * width),
                           .bottom = small_.height};
        if (person.is_thing()) {
            background_->take_in(small_, box);
        } else {
            boxes_.push_back(box);
        }
    }
    std::erase_if(people_, [](const Person& person) { return person.is_thing(); });
    background_->learn(small_, boxes_);
}

void VisitorReader::see(Person& person, const FittedHead& head, MonotonicTime time) {
    const double share = geometry::follow_share(to_seconds(time - person.last), still_mean_s);
    person.head = head;
    person.last = time;
    person.mean += share * (head.pixel - person.mean);
    if (glm::distance(person.mean, person.still_at) > moved_px) {
        person.still_at = person.mean;
        person.moved = time;
    }
}

/// Assigns each head to the nearest person within `same_head` widths, nearest pair first.
void VisitorReader::follow(MonotonicTime time) {
    while (!fitted_.empty()) {
        Person* nearest = nullptr;
        std::size_t which = 0;
        double least = same_head;
        for (Person& person : people_) {
            for (std::size_t k = 0; k < fitted_.size() && person.last != time; ++k) {
                const double off = glm::distance(fitted_[k].pixel, person.head.pixel) / fitted_[k].width_px;
                if (off < least) {
                    least = off;
                    nearest = &person;
                    which = k;
                }
            }
        }
        if (nearest == nullptr) {
            break;
        }
        see(*nearest, fitted_[which], time);
        fitted_.erase(fitted_.begin() + static_cast<std::ptrdiff_t>(which));
    }
    for (const FittedHead& head : fitted_) {
        people_.push_back({.number = ++last_number_,
                           .head = head,
                           .first = time,
                           .last = time,
                           .still_at = head.pixel,
                           .mean = head.pixel,
                           .moved = time});
    }
    std::erase_if(people_, [time](const Person& person) {
        return time - person.last > forgotten_after || time < person.last;
    });
    for (const Person& person : people_) {
        if (person.last == time && time - person.first >= sure_after && !person.is_thing()) {
            heads_.push_back(seen(person));
        }
    }
}

/// The uncertainty of the distance counts only by the angle between the camera's ray and the line from the
/// table to the head.
tracking::SeenHead VisitorReader::seen(const Person& person) const {
    const glm::dvec3& middle = person.head.middle_m;
    const glm::dvec3 ray = glm::normalize(middle - set_up_.table_from_camera.translation);
    const double apart = glm::length(glm::cross(ray, glm::normalize(middle - middle_of_table())));
    return {.time = person.last,
            .person = person.number,
            .middle_m = middle,
            .across_sd_m = std::hypot(person.head.across_sd_m, apart * person.head.along_sd_m)};
}

} // namespace frustumscreen::visitor
