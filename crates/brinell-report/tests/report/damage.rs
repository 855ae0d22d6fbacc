//! The section of the page about damage.

use super::sample::{filled, ordinary, square_with_a_hole};
use brinell::derived::Passing;
use brinell_report::{
    DamageCurve, DamageCurves, DamagePanel, DamageView, Layout, PressureView, damage_passage, damage_plan,
    damage_pressure, damage_section, html, pictures,
};

#[test]
fn analytic_the_plan_is_to_one_scale_and_a_hole_winds_against_its_outline() {
    for layout in [Layout::Wide, Layout::Narrow] {
        let svg = damage_plan(&square_with_a_hole(), 0, layout).svg();
        let path = svg.split("<path d=\"").find(|p| p.contains("fill=\"#f2aa6b\"")).expect("the damage is drawn");
        let rings: Vec<Vec<[f64; 2]>> = path
            .split('"')
            .next()
            .unwrap()
            .split('Z')
            .filter(|r| !r.is_empty())
            .map(|r| {
                let points = r.trim_start_matches('M').split('L');
                points
                    .map(|p| {
                        let (x, y) = p.split_once(' ').unwrap();
                        [x.parse().unwrap(), y.parse().unwrap()]
                    })
                    .collect()
            })
            .collect();
        assert_eq!(rings.len(), 2);
        let area = |r: &[[f64; 2]]| -> f64 {
            let next = r.iter().skip(1).chain(r.first());
            0.5 * r.iter().zip(next).map(|(a, b)| a[0] * b[1] - b[0] * a[1]).sum::<f64>()
        };
        let (outer, hole) = (area(&rings[0]), area(&rings[1]));
        assert!(outer * hole < 0.0, "{outer} {hole}");
        assert!((outer / hole + 4.0).abs() < 0.02, "{outer} {hole}");
        let side = |k: usize| {
            (0..4).map(|i| rings[0][i][k]).fold(0.0, f64::max)
                - (0..4).map(|i| rings[0][i][k]).fold(f64::INFINITY, f64::min)
        };
        assert!((side(0) / side(1) - 1.0).abs() < 0.005, "{} {}", side(0), side(1));
    }
}

#[test]
fn regress_a_view_of_nothing_is_drawn_all_the_same() {
    let empty = DamageView::default();
    for draw in [damage_plan, damage_passage, damage_section] {
        let picture = draw(&empty, 0, Layout::Narrow);
        assert!(picture.png(1.0).is_ok());
    }
}

/// Where upright strokes of a width stand, px.
fn uprights(svg: &str, width: &str) -> Vec<f64> {
    let tree = roxmltree::Document::parse(svg).expect("valid");
    let x = |part: &str| {
        let numbers = part.split(|c: char| !(c.is_ascii_digit() || c == '.' || c == '-'));
        let numbers: Vec<f64> = numbers.filter_map(|x| x.parse().ok()).collect();
        (numbers.len() == 4 && numbers[0] == numbers[2]).then(|| numbers[0])
    };
    tree.descendants()
        .filter(|n| n.attribute("stroke-width") == Some(width))
        .filter_map(|n| n.attribute("d"))
        .flat_map(|d| d.split('M').filter_map(x).collect::<Vec<f64>>())
        .collect()
}

#[test]
fn analytic_the_line_of_contact_is_where_rollers_come_onto_the_damage() {
    let drawn = |passing| damage_plan(&DamageView { passing, ..square_with_a_hole() }, 0, Layout::Wide).svg();
    let line = |passing| uprights(&drawn(passing), "2.4")[0];
    let (plus, minus) = (line(Passing::TowardsPlus), line(Passing::TowardsMinus));
    // The square lies in the middle of its picture.
    assert!(plus < minus, "{plus} {minus}");
    assert_eq!(line(Passing::Both { plus_at_positive: true }), plus);
    assert_eq!(line(Passing::Both { plus_at_positive: false }), minus);
    assert!(drawn(Passing::TowardsPlus).contains("rollers pass to the right"));
    assert!(drawn(Passing::TowardsMinus).contains("rollers pass to the left"));
    assert!(!drawn(Passing::Never).contains("entry"));
}

#[test]
fn analytic_a_rollers_view_goes_once_around_with_both_contacts_half_a_turn_apart() {
    let around = 6.0 * std::f64::consts::PI;
    let view = DamageView { half_turn_mm: Some(0.5 * around), load_zone_mm: None, ..square_with_a_hole() };
    let svg = damage_plan(&view, 0, Layout::Wide).svg();
    assert!(svg.contains("Around the roller") && svg.contains("the other raceway"));
    // The contacts in blue, 2.4 and 2 wide, and the ends of the roller's surface.
    let uprights = |width: &str| uprights(&svg, width);
    let (one, other) = (uprights("2.4"), uprights("2"));
    assert!(one.len() == 1 && other.len() == 1, "{one:?} {other:?}");
    let ends = uprights("1");
    let [.., from, to] = ends[..] else { panic!("the ends of the surface are drawn: {ends:?}") };
    let mm = (other[0] - one[0]).abs() / (to - from).abs() * around;
    assert!((mm - 0.5 * around).abs() < 0.05, "{one:?} {other:?} {ends:?}");
}

#[test]
fn regress_damage_that_cannot_be_drawn_is_not_called_healthy() {
    let mut report = filled("plain", &[1.0, -2.0, 3.0], 1e-4, 250.0);
    report.damage.clear();
    report.undrawn_damage = Some("contact.slices: 0".into());
    let page = html(&report.page());
    assert!(page.contains("could not be drawn") && page.contains("contact.slices: 0"));
    assert!(!page.contains("The bearing is healthy."));
    report.undrawn_damage = None;
    assert!(html(&report.page()).contains("The bearing is healthy."));
}

#[test]
fn regress_the_page_shows_the_roller_passage_and_the_rings_section() {
    let mut report = ordinary();
    let curve = |name: &str| DamageCurve { name: name.into(), values: vec![1.0, 2.0, 1.0] };
    let panel = |label: &str| DamagePanel {
        label: label.into(),
        unit: "mm".into(),
        from_zero: true,
        curves: vec![curve("in contact, L_e"), curve("damaged, L_s")],
    };
    let curves = |title: &str, label: &str, note: &str| DamageCurves {
        title: title.into(),
        along: vec![-1.0, 0.0, 1.0],
        panels: vec![panel(label)],
        note: note.into(),
    };
    report.damage = vec![DamageView {
        passage: curves("Contact conditions during roller passage", "Length", "stiffness at 1 um"),
        section: curves("Section under it", "Thickness", ""),
        ..square_with_a_hole()
    }];
    let page = html(&report.page());
    for words in ["Contact conditions during roller passage", "Section under it", "Stiffness at 1 um."] {
        assert!(page.contains(words), "{words}");
    }
    // Symbols have lowered indices, not underscores.
    assert!(!page.contains(">damaged, L_s<") && page.contains(">damaged, L<tspan"));
    let names: Vec<String> = pictures(&report.page(), Layout::Wide).into_iter().map(|p| p.name).collect();
    for name in ["damage-1", "damage-1-passage", "damage-1-section"] {
        assert!(names.iter().any(|n| n == name), "{names:?}");
    }
}

#[test]
fn analytic_pressures_are_drawn_a_picture_a_contact_with_the_cells_beyond_yield_outlined() {
    // Three cells by two, the middle one of the upper row beyond.
    let of = |contact: &str| PressureView {
        title: format!("Pressure of the {contact} contact"),
        contact: contact.into(),
        start_mm: [-0.1, -0.5],
        step_mm: [0.1, 1.0],
        columns: 3,
        pressure_mpa: vec![100.0, 900.0, 100.0, 500.0, 4000.0, 500.0],
        largest_mpa: 4000.0,
        at_mm: [0.0, 0.5],
        yield_mpa: 3420.0,
        note: "largest 4000 MPa".into(),
        ..PressureView::default()
    };
    assert_eq!(of("outer").middles_mm(), [vec![-0.1, 0.0, 0.1], vec![-0.5, 0.5]]);
    let mut report = ordinary();
    report.damage = vec![DamageView { pressures: vec![of("outer"), of("inner")], ..square_with_a_hole() }];
    let page = html(&report.page());
    assert!(page.contains("Pressure of the inner contact") && page.contains("Largest 4000 MPa."));
    let all = pictures(&report.page(), Layout::Wide);
    let drawn: Vec<_> = all.iter().filter(|p| p.name.starts_with("damage-1-pressure-")).collect();
    assert_eq!(drawn.iter().map(|p| &p.name[18..]).collect::<Vec<_>>(), ["outer", "inner"]);
    for picture in drawn {
        let svg = picture.svg();
        assert!(svg.contains("beyond 3420 MPa") && svg.contains("largest, 4000 MPa"));
        let edges = svg.split("<path d=\"").filter(|path| path.matches('M').count() == 4 && path.contains("#D55E00"));
        assert_eq!(edges.count(), 1, "the four sides of one cell");
    }
    // Alone it needs no side; where nothing is beyond there is nothing to outline.
    let calm = PressureView { yield_mpa: 5000.0, ..of("outer") };
    let view = DamageView { pressures: vec![calm.clone()], ..square_with_a_hole() };
    let picture = damage_pressure(&view, &calm, 0, Layout::Narrow);
    assert!(picture.name == "damage-1-pressure" && !picture.svg().contains("beyond"));
    assert!(damage_pressure(&view, &PressureView::default(), 0, Layout::Wide).svg().contains("Nothing touches"));
}

fn seen(text: &str) -> brinell_report::Damage {
    let s = brinell::document::read(text, &[]).unwrap().scenario;
    brinell_report::damage_of(&s, None).unwrap().remove(0)
}

#[test]
fn analytic_numbers_of_a_depth_map_are_those_of_the_surface_between_its_nodes() {
    let text = "[bearing]\npreset = \"NN3007\"\n[operation]\nspeed_rpm = 1800\nload_n = [300, 0]\n[simulation]\nlaws = \"li2023\"\n\
                [[defects]]\non = \"outer-raceway\"\n[defects.shape.depth_map]\nds_mm = 0.5\ndz_mm = 0.5\ncolumns = 5\nrows = 5\n\
                depth_um = [0,0,0,0,0, 0,10,10,10,0, 0,10,10,10,0, 0,10,10,10,0, 0,0,0,0,0]\n";
    let ecl = seen(text);
    let m = ecl.measures;
    for (name, found, expected) in [
        ("length", m.length_mm, 2.0),
        ("width", m.widest_mm, 2.0),
        ("area", m.area_mm2, 4.0),
        ("volume, um mm^2", m.area_mm2 * m.mean_depth_um, 22.5),
    ] {
        assert!((found - expected).abs() < 1e-9, "{name}: {found}");
    }
    // The law `ecl` counts nodes, and that is said where it is the law.
    let told = |damage: &brinell_report::Damage| {
        damage.view.facts.iter().any(|f| f.label == "Largest damaged length in the law ecl")
    };
    assert!(told(&ecl));
    assert!(!told(&seen(
        &text
            .replace("laws = \"li2023\"", "laws = \"mechanics\"")
            .replace("[[defects]]", "[contact]\ntables = \"quick\"\n[[defects]]")
    )));
}

#[test]
fn analytic_the_load_zone_is_the_static_one_whatever_rests_on_the_inner_ring() {
    // Slow and with gravity: rollers at the top lie on the inner ring and carry nothing.
    let text = |center: f64| {
        format!(
            "[bearing]\npreset = \"NU206\"\n[operation]\nspeed_rpm = 300\nload_n = [0, -7300]\nload_on = \"inner-ring\"\n\
             gravity_m_per_s2 = [0, -9.81]\n[simulation]\nstart = \"equilibrium\"\n[[defects]]\non = \"outer-raceway\"\n\
             center_deg = {center}\ndepth_um = 20\nshape = {{ rectangle = {{ length_mm = 2, width_mm = 4 }} }}\n"
        )
    };
    let s = brinell::document::read(&text(-90.0), &[]).unwrap().scenario;
    let zone = brinell::statics::static_load_zone(&brinell::model::Model::new(&s).unwrap()).unwrap();
    let below = seen(&text(-90.0));
    let share = below.measures.load_zone_share.unwrap();
    assert!((share - below.measures.arc_deg / zone.extent.to_degrees()).abs() < 1e-9, "{share}");
    assert!((2.0..2.4).contains(&zone.extent), "{} rad", zone.extent);
    let [from, to] = below.view.load_zone_mm.unwrap();
    assert!(from < -1.0 && to > 1.0, "{from} to {to} mm");
    // At the top the zone is half a turn away.
    let [from, to] = seen(&text(90.0)).view.load_zone_mm.unwrap();
    assert!(from > 1.0 || to < -1.0, "{from} to {to} mm");
}
