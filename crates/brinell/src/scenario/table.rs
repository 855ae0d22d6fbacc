//! A table of a damaged contact, delta_eff(s, delta) or E(s, delta), as it is exchanged between programs: CSV with the columns `s_mm`,
//! `delta_um` and `delta_eff_um` or `energy_j` on a full grid (section 19).

use std::cmp::Ordering;
use std::collections::HashMap;
use std::fmt;

/// What damage makes of a contact, on a full grid of s and delta.
#[derive(Debug, Clone, PartialEq)]
pub struct TableData {
    /// s, rising.
    pub s_mm: Vec<f64>,
    /// delta, rising.
    pub delta_um: Vec<f64>,
    /// All of the first s, then of the next.
    pub values: TableValues,
}

/// Values of a table.
#[derive(Debug, Clone, PartialEq)]
pub enum TableValues {
    /// delta_eff, um: the deformation at which the healthy contact stores as much.
    DeltaEffUm(Vec<f64>),
    /// E, J: the elastic energy of the contact.
    EnergyJ(Vec<f64>),
}

/// One of [`TableValues`].
pub(crate) type OfList = fn(Vec<f64>) -> TableValues;

impl TableValues {
    /// Name of their column.
    pub fn name(&self) -> &'static str {
        match self {
            Self::DeltaEffUm(_) => VALUES[0].0,
            Self::EnergyJ(_) => VALUES[1].0,
        }
    }

    /// The numbers.
    pub fn list(&self) -> &[f64] {
        match self {
            Self::DeltaEffUm(list) | Self::EnergyJ(list) => list,
        }
    }
}

/// What is wrong with a table.
#[derive(Debug, Clone, PartialEq)]
pub struct TableFault {
    /// Line of the file, from 1, where one is at fault.
    pub line: Option<usize>,
    /// What is wrong.
    pub message: String,
    /// What would do.
    pub allowed: String,
}

impl fmt::Display for TableFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(line) = self.line {
            write!(f, "line {line}: ")?;
        }
        write!(f, "{}; {}", self.message, self.allowed)
    }
}

impl std::error::Error for TableFault {}

const AXES: [&str; 2] = ["s_mm", "delta_um"];
/// The third column is one of these.
const VALUES: [(&str, OfList); 2] = [("delta_eff_um", TableValues::DeltaEffUm), ("energy_j", TableValues::EnergyJ)];
/// Nodes of a table at most: a scenario that has them written out still reads (`document/source.rs`).
const MOST_NODES: usize = 400_000;
/// Shares of delta by which delta_eff may differ at a table's ends: within it a table's nodes are known (section 19).
const HEALTHY_SHARE: f64 = 0.005;
/// The same in um, for deltas near 0: digits of a file.
const HEALTHY_UM: f64 = 0.001;

fn fault(line: Option<usize>, message: impl Into<String>, allowed: impl Into<String>) -> TableFault {
    TableFault { line, message: message.into(), allowed: allowed.into() }
}

/// A node as the file has it: its line, s, delta, delta_eff.
type Row = (usize, [f64; 3]);

impl TableData {
    /// Of the text of a CSV file: a line of column names, then numbers, a node of the grid each, in any order. Further
    /// columns, empty lines and lines that begin with `#` are left aside.
    ///
    /// # Errors
    /// The first thing that is wrong, with its line.
    pub fn from_csv_text(text: &str) -> Result<TableData, TableFault> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let lines = text.lines().enumerate().map(|(i, line)| (i + 1, line.trim()));
        let mut lines = lines.filter(|(_, line)| !line.is_empty() && !line.starts_with('#'));
        let needed = "a line with the columns s_mm,delta_um,delta_eff_um (or energy_j) comes first";
        let (number, head) = lines.next().ok_or_else(|| fault(None, "the file is empty", needed))?;
        let names: Vec<&str> = head.split(',').map(|name| name.trim().trim_matches('"')).collect();
        let (values, of) = *VALUES.iter().find(|(column, _)| names.contains(column)).unwrap_or(&VALUES[0]);
        let columns = [AXES[0], AXES[1], values];
        let mut places = [0; 3];
        for (place, column) in places.iter_mut().zip(columns) {
            let found = names.iter().position(|name| *name == column);
            let missing = || match head.contains([';', '\t']) {
                true => format!(
                    "there is no column {column}: columns are separated by commas, and this line has semicolons or tabs"
                ),
                false => format!("there is no column {column}"),
            };
            *place = found.ok_or_else(|| fault(Some(number), missing(), needed))?;
        }
        let rows: Vec<Row> =
            lines.map(|(number, line)| row(number, line, (places, columns))).collect::<Result<_, _>>()?;
        if rows.len() > MOST_NODES {
            return Err(fault(Some(number), format!("{} nodes", rows.len()), format!("at most {MOST_NODES} of them")));
        }
        let [s_mm, delta_um, list] = on_grid(&rows)?;
        let table = TableData { s_mm, delta_um, values: of(list) };
        table.check()?;
        Ok(table)
    }

    /// Whether it is a table that a run can use.
    ///
    /// # Errors
    /// The first thing that is wrong.
    pub fn check(&self) -> Result<(), TableFault> {
        let rises = |pair: &[f64]| pair[0].partial_cmp(&pair[1]) == Some(Ordering::Less);
        let falls = |pair: &[f64]| matches!(pair[0].partial_cmp(&pair[1]), Some(Ordering::Greater) | None);
        for (name, nodes) in [("s_mm", &self.s_mm), ("delta_um", &self.delta_um)] {
            if nodes.len() < 2 {
                return Err(fault(None, format!("{} {name}", nodes.len()), format!("two {name} or more")));
            }
            if let Some(pair) = nodes.windows(2).find(|pair| !rises(pair)) {
                return Err(fault(
                    None,
                    format!("{name} goes from {} to {}", pair[0], pair[1]),
                    format!("{name} rising"),
                ));
            }
        }
        let wanted = self.s_mm.len().saturating_mul(self.delta_um.len());
        let (name, list) = (self.values.name(), self.values.list());
        if list.len() != wanted {
            let message = format!("{} {name}", list.len());
            return Err(fault(None, message, format!("{wanted}, one for each s_mm and delta_um")));
        }
        for (s, of_s) in self.s_mm.iter().zip(list.chunks(self.delta_um.len())) {
            if let Some(k) = of_s.windows(2).position(falls) {
                let message = format!(
                    "at s_mm = {s} {name} goes from {} to {} where delta_um goes from {} to {}",
                    of_s[k],
                    of_s[k + 1],
                    self.delta_um[k],
                    self.delta_um[k + 1]
                );
                return Err(fault(None, message, format!("{name} that never falls where delta_um rises")));
            }
        }
        match &self.values {
            TableValues::DeltaEffUm(list) => self.is_healthy_at_its_ends(list),
            // Only beside the healthy contact: when a model is made.
            TableValues::EnergyJ(_) => Ok(()),
        }
    }

    /// Outside its s a contact is healthy: at both ends delta_eff is delta, or the force would jump there.
    fn is_healthy_at_its_ends(&self, list: &[f64]) -> Result<(), TableFault> {
        let rows = || self.s_mm.iter().zip(list.chunks(self.delta_um.len()));
        for (s, of_s) in rows().take(1).chain(rows().next_back()) {
            // Nothing touches below 0, however far.
            let off = |(delta, effective): &(&f64, &f64)| {
                (effective.max(0.0) - delta.max(0.0)).abs() > HEALTHY_SHARE * delta.abs() + HEALTHY_UM
            };
            if let Some((delta, effective)) = self.delta_um.iter().zip(of_s).find(off) {
                return Err(fault(
                    None,
                    format!(
                        "at its end s_mm = {s} delta_eff_um is {effective} where delta_um is {delta}, and beyond it the contact is healthy: the \
                         force would jump there; look at the units (mm, um) of all columns, and whether the table was cut short"
                    ),
                    format!(
                        "delta_eff_um within {} % and {HEALTHY_UM} um of delta_um at the first and the last s_mm",
                        100.0 * HEALTHY_SHARE
                    ),
                ));
            }
        }
        Ok(())
    }
}

fn row(number: usize, line: &str, (places, columns): ([usize; 3], [&str; 3])) -> Result<Row, TableFault> {
    let cells: Vec<&str> = line.split(',').collect();
    let mut values = [0.0; 3];
    for ((value, place), column) in values.iter_mut().zip(places).zip(columns) {
        let needed = format!("a finite number in each of {}, {} and {}", columns[0], columns[1], columns[2]);
        let Some(cell) = cells.get(place) else {
            return Err(fault(Some(number), format!("there is no {column}"), needed));
        };
        let read = cell.trim().trim_matches('"').parse::<f64>().ok().filter(|x| x.is_finite());
        *value = read.ok_or_else(|| fault(Some(number), format!("{column} is \"{}\"", cell.trim()), needed))?;
        // One zero.
        *value += 0.0;
    }
    Ok((number, values))
}

/// The nodes in order; the grid is that of all s and all delta there are.
fn on_grid(rows: &[Row]) -> Result<[Vec<f64>; 3], TableFault> {
    let axis = |which: usize| {
        let mut all: Vec<f64> = rows.iter().map(|(_, values)| values[which]).collect();
        all.sort_by(f64::total_cmp);
        all.dedup();
        all
    };
    let (s_mm, delta_um) = (axis(0), axis(1));
    let mut nodes: HashMap<[u64; 2], usize> = HashMap::new();
    for (number, [s, delta, _]) in rows {
        if let Some(first) = nodes.insert([s.to_bits(), delta.to_bits()], *number) {
            let message = format!("s_mm = {s}, delta_um = {delta} stands in line {first} already");
            return Err(fault(Some(*number), message, "each node of the grid once"));
        }
    }
    if nodes.len() != s_mm.len().saturating_mul(delta_um.len()) {
        for s in &s_mm {
            for delta in &delta_um {
                if !nodes.contains_key(&[s.to_bits(), delta.to_bits()]) {
                    let message = format!("there is no node s_mm = {s}, delta_um = {delta}");
                    return Err(fault(None, message, "a full grid: every delta_um at every s_mm"));
                }
            }
        }
    }
    let mut order: Vec<&Row> = rows.iter().collect();
    order.sort_by(|(_, a), (_, b)| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let list = order.iter().map(|(_, values)| values[2]).collect();
    Ok([s_mm, delta_um, list])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prop_a_table_is_read_in_any_order_of_its_lines() {
        let ordered = "s_mm,delta_um,delta_eff_um\n-1,0,0\n-1,2,2\n0.5,0,-1\n0.5,2,0.8\n1,0,0\n1,2,2\n";
        let mixed = "\u{feff}# from a solver\r\nnote, delta_eff_um,delta_um,s_mm\r\nx,0.8,2,0.5\r\n\r\n,0,-0.0,-1\r\n,2,2,-1\r\n,0,0,1\r\n,-1,0,0.5\r\n,2,2,1\r\n";
        let table = TableData::from_csv_text(ordered).unwrap();
        assert_eq!(table.s_mm, [-1.0, 0.5, 1.0]);
        assert_eq!(table.delta_um, [0.0, 2.0]);
        assert_eq!(table.values, TableValues::DeltaEffUm(vec![0.0, 2.0, -1.0, 0.8, 0.0, 2.0]));
        let energies =
            TableData::from_csv_text(&ordered.replace("delta_eff_um", "energy_j").replace(",-1\n", ",0\n")).unwrap();
        assert_eq!(energies.values, TableValues::EnergyJ(vec![0.0, 2.0, 0.0, 0.8, 0.0, 2.0]));
        assert_eq!(TableData::from_csv_text(mixed).unwrap(), table);
    }

    #[test]
    fn prop_what_is_no_table_is_refused_with_its_line() {
        let head = "s_mm,delta_um,delta_eff_um\n";
        for (body, line, words) in [
            ("", None, "0 s_mm"),
            ("0,0,0\n0,1,1\n1,0,0\n", None, "no node s_mm = 1, delta_um = 1"),
            ("0,0,0\n0,1,1\n0,0,0\n", Some(4), "stands in line 2 already"),
            ("0,0,nan\n", Some(2), "delta_eff_um is \"nan\""),
            ("0,0\n", Some(2), "there is no delta_eff_um"),
            ("0,0,0\n0,1,x\n", Some(3), "delta_eff_um is \"x\""),
            ("0,0,0\n0,1,1\n1,0,2\n1,1,1\n", None, "goes from 2 to 1"),
        ] {
            let fault = TableData::from_csv_text(&format!("{head}{body}")).unwrap_err();
            assert_eq!(fault.line, line, "{body}: {fault}");
            assert!(fault.to_string().contains(words), "{body}: {fault}");
        }
        let fault = TableData::from_csv_text("s_mm,delta_um\n0,0\n").unwrap_err();
        assert_eq!((fault.line, &fault.message[..]), (Some(1), "there is no column delta_eff_um"));
        assert!(TableData::from_csv_text(" \n").unwrap_err().message.contains("empty"));
    }
}
