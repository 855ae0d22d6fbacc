//! The tables of damage (section 19) made beside the bearings that run: by another engine, whose tables are handed over.

use crate::answers::{Reply, Table, Tables};
use crate::message::Arrays;
use crate::pen;
use crate::report::{Answer, Trouble};
use brinell::Error;
use brinell::half_space::{in_bytes, take_in};
use brinell::model::Model;
use serde_json::Value;

/// `tables`: makes those of a scenario. Their bytes are for an engine in another process.
pub(crate) fn made(request: &Value, arrays: &mut Arrays) -> Answer<Reply> {
    let (loaded, _) = pen::asked(request)?;
    Model::new(&loaded.scenario).map_err(Error::from)?;
    let all = if request["bytes"] == true { in_bytes() } else { Vec::new() };
    let table = |(name, bytes): (_, Vec<u8>)| Table { name, bytes: arrays.bytes(&bytes) };
    Ok(Reply::Tables(Tables { tables: all.into_iter().map(table).collect() }))
}

/// `take`: has what another engine made.
pub(crate) fn taken(request: &Value, given: &Arrays) -> Answer<Reply> {
    for table in request["tables"].as_array().into_iter().flatten() {
        let of = table["name"].as_str().zip(given.octets(&table["bytes"]));
        if !of.is_some_and(|(name, bytes)| take_in(name, bytes)) {
            return Err(Trouble::of("what was given is no table of this version"));
        }
    }
    Ok(Reply::Take {})
}
