//! Defect frequencies on a frequency axis.

use crate::chart::{Lane, Mark};
use crate::data::Marker;
use crate::number::significant;
use crate::picture::ink;

fn usable(markers: &[Marker]) -> impl Iterator<Item = &Marker> {
    markers.iter().filter(|m| m.frequency_hz.is_finite() && m.frequency_hz > 0.0)
}

/// The markers that decide what is shown: those of damage that is there, or all of them.
pub(super) fn telling(markers: &[Marker]) -> Vec<&Marker> {
    let present: Vec<&Marker> = usable(markers).filter(|m| m.present).collect();
    if present.is_empty() { usable(markers).collect() } else { present }
}

const MARKER_COLORS: [&str; 6] = [ink::VERMILLION, ink::GREEN, ink::PURPLE, ink::ORANGE, ink::SKY, ink::BLACK];

pub(crate) fn marker_lanes(markers: &[Marker]) -> Vec<Lane> {
    usable(markers)
        .enumerate()
        .map(|(index, marker)| Lane {
            label: marker.label.clone(),
            value: format!(
                "{} Hz{}",
                significant(marker.frequency_hz, 4),
                if marker.pure_rolling_hz.is_some() { " found" } else { "" }
            ),
            color: MARKER_COLORS[index % MARKER_COLORS.len()],
            dash: &[4.0, 3.0],
            through: marker.present,
            marks: (1..=marker.harmonics.clamp(1, 200))
                .map(|n| Mark {
                    x: n as f64 * marker.frequency_hz,
                    name: if n == 1 { marker.label.clone() } else { format!("{n} × {}", marker.label) },
                    label: if n == 1 { String::new() } else { format!("×{n}") },
                })
                .collect(),
            minor: (marker.sidebands.iter())
                .map(|(x, name)| Mark { x: *x, name: name.clone(), label: String::new() })
                .collect(),
        })
        .collect()
}

/// The same of orders, which have no unit.
pub(crate) fn order_lanes(markers: &[Marker]) -> Vec<Lane> {
    let mut lanes = marker_lanes(markers);
    for (lane, marker) in lanes.iter_mut().zip(usable(markers)) {
        lane.value = significant(marker.frequency_hz, 4);
    }
    lanes
}
