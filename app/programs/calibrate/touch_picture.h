/// What the projector shows a technician during a calibration by touch, or its touch-up: the cross, how the prop is to lie on it, what to do.
///
/// Units    pixels of the projector's picture.
/// Words    in English, as in the alignment pattern; above them one sentence in the house's language, where that is another one.
/// Threads  as Canvas.
#pragma once

#include "app/calibration/touch_procedure.h"
#include "app/exhibit/text_image.h"
#include "app/image/image.h"
#include "app/pack/words_file.h"

#include <string>
#include <vector>

namespace frustumscreen {

/// The first line is the largest.
[[nodiscard]] std::vector<std::string> touch_words(const TouchProcedure& procedure);
/// The key of what is said now among the exhibit's own words.
[[nodiscard]] std::string_view word_key(const TouchProcedure& procedure);
/// `house`: the house's words, or null. `prop_px`: about the width of the prop's bottom, from under which the cross's arms reach out.
[[nodiscard]] Image8 touch_picture(const TouchProcedure& procedure, int width, int height, double prop_px,
                                   const Typesetter& typesetter, const LanguageWords* house = nullptr);

} // namespace frustumscreen
