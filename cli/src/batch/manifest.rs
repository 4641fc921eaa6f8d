//! Manifests: what is in the file, before anything of it is understood.

use super::args::BatchArgs;
use crate::failure::Failure;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::fs;
use std::path::Path;
use toml::{Table, Value};

/// The value of a key.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Given {
    Flag(bool),
    One(String),
    Many(Vec<String>),
    /// Of a table without types: the key decides what it means.
    Cell(String),
}

/// Keys in alphabetical order: their order in the file means nothing.
pub(super) type Keys = BTreeMap<String, Given>;

/// What a manifest says.
#[derive(Debug)]
pub(super) struct Manifest {
    pub(super) defaults: Keys,
    pub(super) rows: Vec<Keys>,
}

impl Manifest {
    /// # Errors
    /// The file cannot be read, is neither TOML nor CSV, or has no rows.
    pub(super) fn read(args: &BatchArgs) -> Result<Self, Failure> {
        let path = &args.manifest;
        let text = fs::read_to_string(path).map_err(|error| {
            Failure::file(format!("{}: cannot be read: {error}", path.display()))
        })?;
        let ending = path.extension().map(OsStr::to_ascii_lowercase);
        let parsed = match ending.as_ref().and_then(|ending| ending.to_str()) {
            Some("toml") => Self::from_toml(&text),
            Some("csv") => Self::from_csv(&text),
            _ => Err("a manifest ends in .toml or .csv".to_owned()),
        };
        let mut manifest = parsed.map_err(|error| complaint(path, &error))?;
        if manifest.rows.is_empty() {
            return Err(complaint(
                path,
                "has no rows: `[[row]]` in TOML, lines below the first in CSV",
            ));
        }
        let given =
            args.default.iter().map(|(key, value)| (key.clone(), Given::Cell(value.clone())));
        manifest.defaults.extend(given);
        Ok(manifest)
    }

    fn from_toml(text: &str) -> Result<Self, String> {
        #[derive(Deserialize)]
        #[serde(deny_unknown_fields)]
        struct Document {
            #[serde(default)]
            defaults: Table,
            #[serde(default)]
            row: Vec<Table>,
        }
        let document: Document = toml::from_str(text).map_err(|error| {
            let start = error.span().map_or(0, |span| span.start);
            format!(
                "line {}: {}",
                1 + text[..start].matches('\n').count(),
                one_line(error.message())
            )
        })?;
        let rows = document.row.into_iter().enumerate();
        let rows =
            rows.map(|(i, table)| keys(table).map_err(|error| format!("row {}: {error}", i + 1)));
        let defaults = keys(document.defaults).map_err(|error| format!("[defaults]: {error}"))?;
        Ok(Self { defaults, rows: rows.collect::<Result<_, _>>()? })
    }

    fn from_csv(text: &str) -> Result<Self, String> {
        let mut reader =
            csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_bytes());
        let header = reader.headers().map_err(|error| error.to_string())?.clone();
        if let Some(twice) =
            header.iter().find(|key| header.iter().filter(|k| k == key).count() > 1)
        {
            return Err(format!("two columns are called `{twice}`"));
        }
        let row = |record: Result<csv::StringRecord, csv::Error>| {
            let record = record.map_err(|error| error.to_string())?;
            let cells = header.iter().zip(&record).filter(|(_, cell)| !cell.is_empty());
            Ok(cells.map(|(key, cell)| (key.to_owned(), Given::Cell(cell.to_owned()))).collect())
        };
        let rows = reader.records().map(row).collect::<Result<_, String>>()?;
        Ok(Self { defaults: Keys::new(), rows })
    }
}

/// Says what is wrong with a manifest.
pub(super) fn complaint(manifest: &Path, what: &str) -> Failure {
    Failure::bad_input(format!("{}: {what}", manifest.display()))
}

/// A message of several lines in one.
pub(super) fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn keys(table: Table) -> Result<Keys, String> {
    let pair = |(key, value)| {
        let given = given(value).ok_or_else(|| {
            format!("`{key}`: expected a text, a number, true or false, or a list of them")
        })?;
        Ok((key, given))
    };
    table.into_iter().map(pair).collect()
}

fn given(value: Value) -> Option<Given> {
    match value {
        Value::Boolean(is_set) => Some(Given::Flag(is_set)),
        Value::Array(values) => values.iter().map(item).collect::<Option<_>>().map(Given::Many),
        value => word(&value).map(Given::One),
    }
}

/// An item of a list; a list of numbers is one item, such as a point.
fn item(value: &Value) -> Option<String> {
    match value {
        Value::Array(parts) => Some(parts.iter().map(word).collect::<Option<Vec<_>>>()?.join(",")),
        value => word(value),
    }
}

fn word(value: &Value) -> Option<String> {
    match value {
        Value::String(text) => Some(text.clone()),
        Value::Integer(number) => Some(number.to_string()),
        Value::Float(number) => Some(number.to_string()),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn toml_has_types() {
        let text = "[defaults]\npower = 12\n[[row]]\ninput = 'a.png'\nend = [[1, 2.5], '3,4']\n\
                    physical = true\nscale = [2, 3]";
        let Manifest { defaults, rows } = Manifest::from_toml(text).unwrap();
        assert_eq!(defaults["power"], Given::One("12".into()));
        assert_eq!(rows[0]["end"], Given::Many(vec!["1,2.5".into(), "3,4".into()]));
        assert_eq!(rows[0]["physical"], Given::Flag(true));
        assert_eq!(rows[0]["scale"], Given::Many(vec!["2".into(), "3".into()]));
    }

    #[test]
    fn csv_has_cells() {
        let Manifest { rows, .. } =
            Manifest::from_csv("input,end, power\na.png,\"1,2; 3,4\",\n\"b,\"\"c\"\".png\",,3\n")
                .unwrap();
        assert_eq!(rows[0].len(), 2, "an empty cell says nothing");
        assert_eq!(rows[0]["end"], Given::Cell("1,2; 3,4".into()));
        assert_eq!(rows[1]["input"], Given::Cell("b,\"c\".png".into()));
        assert_eq!(rows[1]["power"], Given::Cell("3".into()));
    }

    #[test]
    fn mistakes_say_where_they_are() {
        let toml = |text: &str| Manifest::from_toml(text).unwrap_err();
        assert!(toml("[[row]]\ninput = 'a\n").starts_with("line 2: "));
        assert!(toml("[[rows]]\na = 1").contains("unknown field `rows`"), "{}", toml("[[rows]]"));
        assert!(toml("[[row]]\na = 1\n[[row]]\nb = {c = 1}").starts_with("row 2: `b`: expected"));
        assert!(toml("[defaults]\nb = 1979-05-27").starts_with("[defaults]: `b`"));
        let csv = |text: &str| Manifest::from_csv(text).unwrap_err();
        assert!(csv("a,b\n1\n").contains("line: 2"), "{}", csv("a,b\n1\n"));
        assert!(csv("a,a\n1,2\n").contains("two columns are called `a`"));
    }
}
