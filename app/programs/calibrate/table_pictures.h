/// The pictures and words for a technician during a calibration. By touch and in its touch-up: the cross, and
/// how to lay the prop on it. By a camera: where to put the board next, while no stripes are shown. By eye:
/// where to put the prop, the cross behind it, and the corner that should cover the cross. Always: what to do
/// next.
///
/// Light    By a camera the ground is grey instead of black, so that the camera sees the tags meanwhile. By
///          eye a dot lights the corner, and an arrow on the prop's top leads to it.
/// Aim      The prop covers its cross: the arms extend beyond it, and a square shows where it stands. The
///          marks in the middles of its bottom edges are laid on the arms.
/// Units    pixels of the projector's picture.
/// Words    in English, as in the alignment pattern; above them one sentence in the house's language, if that
///          is another one. By touch and by a camera they are where the prop hides none of them; by eye they
///          are beside the prop, where no cross is, as large as they fit.
/// Threads  as Canvas.
#pragma once

#include "app/calibration/procedure/auto_procedure.h"
#include "app/calibration/procedure/eye_procedure.h"
#include "app/calibration/procedure/touch_procedure.h"
#include "app/calibration/touch_up.h"
#include "app/image/image.h"
#include "app/pack/words_file.h"
#include "app/programs/calibrate/table_words.h"
#include "app/typography/text_image.h"

namespace frustumscreen::programs {

[[nodiscard]] TableWords table_words(const calibration::TouchProcedure& procedure);
/// Empty while a pattern is shown.
[[nodiscard]] TableWords table_words(const calibration::AutoProcedure& procedure);
[[nodiscard]] TableWords table_words(const calibration::EyeProcedure& procedure);
/// The key of a word: what is wrong, else how to put the board next. `may_go_on`: Back leads on to the
/// crosses.
[[nodiscard]] std::string_view key_of(calibration::AutoPrompt word, calibration::Posture requested,
                                      bool may_go_on);
/// The result of a technician's touches, in words for the table and as the procedure needs it.
[[nodiscard]] calibration::TouchJudgement judgement_of(const calibration::TouchCalibration& calibration);
[[nodiscard]] calibration::TouchJudgement judgement_of(const calibration::TouchUp& found);

/// Parameters of a picture. By eye its size must be the scene's.
struct TableDrawing {
    int width = 0, height = 0;
    double prop_px = 0.0; ///< approximate width of the prop's bottom on the table
    double above_m =
        0.0; ///< approximate height of the projector, which widens what lies on boards; 0: ignored
    double board_px = 0.0; ///< approximate width of the board
    const typography::Typesetter& typesetter;
    const pack::LanguageWords* own_words = nullptr; ///< the house's words
};
[[nodiscard]] image::Image8 table_picture(const calibration::TouchProcedure& procedure,
                                          const TableDrawing& with);
/// The pattern, if one is shown.
[[nodiscard]] image::Image8 table_picture(const calibration::AutoProcedure& procedure,
                                          const TableDrawing& with);
[[nodiscard]] image::Image8 table_picture(const calibration::EyeProcedure& procedure,
                                          const TableDrawing& with);

} // namespace frustumscreen::programs
