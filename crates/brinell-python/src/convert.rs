//! Values across the border: JSON to Python, Python to TOML, arrays both ways.

use crate::bad_value::bad_value;
use brinell::document::NOT_GIVEN;
use brinell_io::{Cells, Table};
use numpy::{AllowTypeChange, IntoPyArray, PyArray1, PyArrayLike1};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyFrozenSet, PyInt, PyList, PySet, PyString};
use serde_json::Value;
use std::borrow::Cow;
use std::fmt::Write;

/// An array of numbers, taken without a copy where it is contiguous and double.
pub(crate) type Samples<'py> = PyArrayLike1<'py, f64, AllowTypeChange>;

/// The numbers of an array: its own memory, or a copy where that has gaps.
pub(crate) fn slice<'a>(x: &'a Samples<'_>) -> Cow<'a, [f64]> {
    match x.as_slice() {
        Ok(slice) => slice.into(),
        Err(_) => x.as_array().iter().copied().collect(),
    }
}

/// An array that owns these numbers: the memory is handed over, not copied.
pub(crate) fn array(py: Python<'_>, values: Vec<f64>) -> Bound<'_, PyArray1<f64>> {
    values.into_pyarray(py)
}

/// Dicts, lists and numbers.
pub(crate) fn json_to_python<'py>(py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
    Ok(match value {
        Value::Null => py.None().into_bound(py),
        Value::Bool(truth) => PyBool::new(py, *truth).to_owned().into_any(),
        Value::Number(number) => match number.as_i64() {
            Some(n) => n.into_pyobject(py)?.into_any(),
            None => PyFloat::new(py, number.as_f64().unwrap_or(f64::NAN)).into_any(),
        },
        Value::String(text) => PyString::new(py, text).into_any(),
        Value::Array(items) => {
            let list = PyList::empty(py);
            for item in items {
                list.append(json_to_python(py, item)?)?;
            }
            list.into_any()
        }
        Value::Object(entries) => {
            let dict = PyDict::new(py);
            for (key, value) in entries {
                dict.set_item(key, json_to_python(py, value)?)?;
            }
            dict.into_any()
        }
    })
}

/// Columns of a table: name, unit, and an array of numbers with NaN where a cell is empty, or a list of words.
pub(crate) fn table<'py>(py: Python<'py>, table: &Table) -> PyResult<Bound<'py, PyList>> {
    let list = PyList::empty(py);
    for (column, cells) in table.columns.iter().zip(&table.cells) {
        match cells {
            Cells::Numbers(cells) => {
                let numbers = cells.iter().map(|cell| cell.unwrap_or(f64::NAN)).collect();
                list.append((&column.name, &column.unit, array(py, numbers)))?;
            }
            Cells::Words(cells) => list.append((&column.name, &column.unit, cells.clone()))?,
        }
    }
    Ok(list)
}

/// Levels of lists within lists: deeper ones hold themselves.
const DEEPEST: usize = 32;

/// A value as TOML: numbers, strings, paths, booleans, and lists, tuples, arrays and dicts of them; `key` is where it
/// goes.
pub(crate) fn python_to_toml(key: &str, value: &Bound<'_, PyAny>) -> PyResult<String> {
    let mut out = String::new();
    write_toml(&|| key.to_owned(), value, &mut out, 0)?;
    Ok(out)
}

/// `at` words where it goes, once that is to be said.
fn write_toml(at: &dyn Fn() -> String, value: &Bound<'_, PyAny>, out: &mut String, depth: usize) -> PyResult<()> {
    if depth > DEEPEST {
        // The path is as deep as that.
        let path = at();
        let key: Vec<&str> = path.split('.').take(2).collect();
        return Err(bad_value(format!("{}: lists more than {DEEPEST} levels deep", key.join("."))));
    }
    let _ = if let Ok(truth) = value.cast::<PyBool>() {
        write!(out, "{}", truth.is_true())
    } else if value.is_instance_of::<PyInt>() {
        write!(out, "{}", value.str()?)
    } else if let Ok(number) = value.cast::<PyFloat>() {
        out.push_str(&brinell::document::toml_float(number.value()));
        Ok(())
    } else if let Ok(text) = value.cast::<PyString>() {
        out.push_str(&brinell::document::toml_quote(text.to_str()?));
        Ok(())
    } else if let Ok(table) = value.cast::<PyDict>() {
        return write_table(at, table, out, depth);
    } else if value.hasattr("tolist")? {
        return write_toml(at, &value.call_method0("tolist")?, out, depth);
    } else if value.hasattr("__fspath__")? {
        return write_toml(at, &value.call_method0("__fspath__")?, out, depth);
    } else if value.is_instance_of::<PySet>() || value.is_instance_of::<PyFrozenSet>() {
        return Err(PyTypeError::new_err(format!("{} = {}: a set has no order; give a list", at(), value.repr()?)));
    } else if value.hasattr("__iter__")? {
        out.push('[');
        for (k, item) in value.try_iter()?.enumerate() {
            out.push_str(if k == 0 { "" } else { ", " });
            write_toml(&|| format!("{}.{k}", at()), &item?, out, depth + 1)?;
        }
        out.push(']');
        Ok(())
    } else if let Ok(number) = value.extract::<f64>() {
        out.push_str(&brinell::document::toml_float(number));
        Ok(())
    } else {
        let shown = if value.is_none() { "None".into() } else { value.get_type().name()?.to_string() };
        return Err(PyTypeError::new_err(format!(
            "{}: {shown}: a scenario holds numbers, strings, booleans, and lists, arrays and dicts of them",
            at()
        )));
    };
    Ok(())
}

fn write_table(at: &dyn Fn() -> String, table: &Bound<'_, PyDict>, out: &mut String, depth: usize) -> PyResult<()> {
    out.push_str("{ ");
    let mut lead = "";
    for (key, value) in table {
        if value.is_none() {
            continue;
        }
        let wrong = |_| PyTypeError::new_err(format!("{}: {key}: keys of a scenario are strings", at()));
        let key = key.cast::<PyString>().map_err(wrong)?.to_str()?;
        out.push_str(lead);
        out.push_str(&brinell::document::toml_quote(key));
        out.push_str(" = ");
        write_toml(&|| format!("{}.{key}", at()), &value, out, depth + 1)?;
        lead = ", ";
    }
    out.push_str(" }");
    Ok(())
}

/// Overrides: a value by the dotted path of its key; `None` is its default.
pub(crate) fn overrides(settings: &Bound<'_, PyDict>) -> PyResult<Vec<(String, String)>> {
    let mut all = Vec::new();
    for (key, value) in settings {
        let key: String = key
            .extract()
            .map_err(|_| PyTypeError::new_err(format!("{key}: a key is a dotted path, such as operation.speed_rpm")))?;
        let value = if value.is_none() { NOT_GIVEN.to_owned() } else { python_to_toml(&key, &value)? };
        all.push((key, value));
    }
    Ok(all)
}

/// A whole scenario's text from keyword arguments. `None` is left out.
pub(crate) fn document(sections: &Bound<'_, PyDict>) -> PyResult<String> {
    let mut text = String::new();
    for (key, value) in sections {
        if !value.is_none() {
            let key: String = key.extract()?;
            let _ = writeln!(text, "{key} = {}", python_to_toml(&key, &value)?);
        }
    }
    Ok(text)
}
