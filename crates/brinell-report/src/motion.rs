//! The bearing in motion: one instant as a picture, and the frames that the page's script moves it through.

mod frames;
mod row;

use std::f64::consts::TAU;
use std::fmt::Write as _;

use crate::axial;
use crate::encode::{list, packed};
use crate::font;
use crate::layout::{Layout, legend};
use crate::number::{finite, round_below, significant};
use crate::picture::{Anchor, Paint, Picture, Shape, Text, ink};
use brinell::scenario::Surface;
pub use frames::{Motion, MotionDamage, MotionRow};
use row::{COLORS, DrawnRow, RING};

/// Longest line of force, px.
const FORCE: f64 = 46.0;

/// The bearing at one of the instants, a circle to a row.
pub fn bearing_motion(motion: &Motion, frame: usize, layout: Layout) -> Picture {
    let size = layout.size(0.0);
    let font = size.font;
    let (cell, places) = layout.grid(motion.rows.len(), 460.0);
    let mut picture = Picture::new("motion", "The bearing in motion", size.width, 0.0);
    let shown = &COLORS[..if motion.damage.is_empty() { 3 } else { 4 }];
    let frames = motion.frames();
    if frames == 0 {
        picture.height = 4.0 * font;
        let words = Text::new(0.5 * size.width, 2.0 * font, font, Anchor::Middle, "Not recorded");
        picture.text(words);
        return picture;
    }
    let largest = motion.largest();
    let per_newton = if largest > 0.0 { FORCE / largest } else { 0.0 };
    let mut top = legend(&mut picture, shown, 12.0, size.width - 12.0, 2.0, font);
    if largest > 0.0 {
        draw_ruler(&mut picture, largest, per_newton, top + font, font);
        top += 1.6 * font;
    }

    let frame = frame.min(frames - 1);
    let scale = (0.5 * cell - FORCE - 6.0) / motion.outer_radius_mm;
    let mut centres = String::new();
    let tall = cell + 1.6 * font;
    for (index, (row, (left, line))) in motion.rows.iter().zip(&places).enumerate() {
        let (x, y) = (left + 0.5 * cell, top + line * tall + 1.6 * font + 0.5 * cell);
        let _ = write!(centres, " {x:.2} {y:.2}");
        let drawn = DrawnRow { motion, row, frame, centre: (x, y), scale };
        let s = &mut picture.shapes;
        s.push(Shape::Open("m-row"));
        drawn.rings(s);
        drawn.bodies(s);
        drawn.damage(s, index);
        drawn.forces(s, per_newton);
        s.push(Shape::Close);
        let title = font::fitted(&row.title, font, true, cell);
        picture.text(Text::new(x, y - 0.5 * cell - 0.4 * font, font, Anchor::Middle, &title).bold());
    }
    picture.height = top + places.last().map_or(0.0, |(_, line)| line + 1.0) * tall;
    picture.attributes = format!(" data-motion=\"{scale:.4} {per_newton:.6}{centres}\"");
    picture
}

fn draw_ruler(picture: &mut Picture, largest: f64, per_newton: f64, y: f64, font: f64) {
    let round = round_below(largest);
    let end = 12.0 + round * per_newton;
    picture.path(&[(12.0, y), (end, y)], Paint::line(ink::BLACK, 2.2));
    let words = format!("{} N; the largest force here is {} N", significant(round, 2), significant(largest, 3));
    let (x, y) = (end + 8.0, y + 0.36 * font);
    picture.text(Text::new(x, y, font, Anchor::Start, &words));
}

/// Angles as 65536ths of a turn.
fn turns(angles: &[f32]) -> impl Iterator<Item = u16> + '_ {
    let turn = |a: &f32| ((finite(*a) / TAU).rem_euclid(1.0) * 65536.0).round() as u32 as u16;
    angles.iter().map(turn)
}

/// The frames, for the page's script: 16 bits a number, angles in turns and forces as shares of the largest.
pub(crate) fn frames_for_script(page: &mut String, motion: &Motion, frames: usize) {
    let largest = motion.largest();
    let damage = |damage: &MotionDamage| {
        let (kind, roller) = match damage.surface {
            Surface::OuterRaceway => ("outer", 0),
            Surface::InnerRaceway => ("inner", 0),
            Surface::Roller(k) => ("roller", k),
        };
        let [from, to] = damage.angle.map(|a| if a.is_finite() { a.clamp(-TAU, TAU) } else { 0.0 });
        format!("[{},\"{kind}\",{from},{to},{roller}]", damage.row)
    };
    let share =
        |f: &f32| if largest > 0.0 { ((finite(*f) / largest).clamp(0.0, 1.0) * 65535.0).round() as u16 } else { 0 };
    let row = |row: &MotionRow| {
        let of_rollers = frames * row.pockets.len();
        let pockets = list(row.pockets.iter().map(|p| format!("{:.5}", finite(*p))));
        let forces = row.inner_n[..of_rollers].iter().chain(&row.outer_n[..of_rollers]);
        let numbers = turns(&row.orbit[..of_rollers])
            .chain(turns(&row.spin[..of_rollers]))
            .chain(forces.map(share))
            .chain(turns(&row.cage[..frames]));
        format!("{{\"pockets\":{pockets},\"values\":\"{}\"}}", packed(numbers))
    };
    let _ = write!(
        page,
        "<script type=\"application/json\" data-frames=\"{frames}\">{{\"t0\":{},\"dt\":{},\"largest\":{largest},\"inner\":{},\"outer\":{},\
         \"pitch\":{},\"roller\":{},\"thick\":{},\"values\":\"{}\",\"damage\":{},\"rows\":{}",
        motion.t0_s,
        motion.dt_s,
        motion.inner_radius_mm,
        motion.outer_radius_mm,
        motion.pitch_radius_mm,
        motion.roller_radius_mm,
        RING * motion.outer_radius_mm,
        packed(turns(&motion.ring[..frames])),
        list(motion.damage.iter().map(damage)),
        list(motion.rows.iter().map(row)),
    );
    if let Some(section) = motion.section.as_ref().filter(|s| s.frames() >= frames) {
        axial::data(page, section, frames);
    }
    page.push_str("}</script>\n");
}
