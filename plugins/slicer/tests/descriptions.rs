//! What modules say about themselves keeps the rules of all hosts.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

use heatpath_slicer::modules::ALL;
use heatpath_slicer::{Channel, Kind, Module, Parameter, Request, command_line, description};
use quick_xml::events::Event;
use std::ffi::OsString;

fn parameters(module: &'static Module) -> impl Iterator<Item = &'static Parameter> {
    module.groups.iter().flat_map(|group| group.parameters)
}

/// The elements of an XML text: how deep each is, its name and its text.
fn elements(xml: &str) -> Vec<(usize, String, String)> {
    let mut reader = quick_xml::Reader::from_str(xml);
    let (mut list, mut open) = (Vec::<(usize, String, String)>::new(), Vec::new());
    loop {
        match reader.read_event().unwrap() {
            Event::Start(tag) => {
                let name = tag.name().as_ref().to_owned();
                list.push((open.len(), name, String::new()));
                open.push(list.len() - 1);
            }
            Event::Text(text) => {
                if let Some(&innermost) = open.last() {
                    list[innermost].2.push_str(&text);
                }
            }
            Event::End(_) => drop(open.pop()),
            Event::Eof => return list,
            _ => (),
        }
    }
}

#[test]
fn names_are_words_that_all_hosts_take() {
    let is_word = |name: &str| {
        name.starts_with(|c: char| c.is_ascii_alphabetic())
            && name.chars().all(|c| c.is_ascii_alphanumeric())
    };
    for module in ALL {
        assert!(is_word(module.name), "{}", module.name);
        let mut names: Vec<&str> = parameters(module).map(|parameter| parameter.name).collect();
        assert!(names.iter().all(|name| is_word(name)), "{names:?}");
        let all = names.len();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), all, "{}: a name is there twice", module.name);
    }
}

#[test]
fn files_without_option_come_in_order() {
    for module in ALL {
        let positions: Vec<usize> = parameters(module)
            .filter_map(|parameter| match parameter.kind {
                Kind::File { position, .. } => position,
                _ => None,
            })
            .collect();
        assert_eq!(positions, [0, 1], "{}", module.name);
    }
}

#[test]
fn children_have_the_order_that_ctk_demands() {
    let order =
        ["name", "longflag", "index", "description", "label", "default", "channel", "element"];
    for module in ALL {
        let xml = description(module);
        assert!(xml.starts_with("<?xml"));
        let elements = elements(&xml);
        let mut found = 0;
        for (i, (depth, tag, _)) in elements.iter().enumerate() {
            if *depth != 2 || ["label", "description"].contains(&tag.as_str()) {
                continue;
            }
            found += 1;
            let children = elements[i + 1..].iter().take_while(|(depth, ..)| *depth == 3);
            let children: Vec<&str> = children.map(|(_, name, _)| name.as_str()).collect();
            let places = children.iter().map(|child| order.iter().position(|own| own == child));
            let places: Vec<usize> = places.map(Option::unwrap).collect();
            assert!(places.is_sorted(), "{tag}: {children:?}");
            assert_eq!(children.first(), Some(&"name"));
            let is_file = ["image", "geometry", "file"].contains(&tag.as_str());
            assert_eq!(children.contains(&"channel"), is_file, "{tag}: {children:?}");
        }
        assert_eq!(found, parameters(module).count());
    }
}

#[test]
fn texts_come_back_as_they_were() {
    for module in ALL {
        let elements = elements(&description(module));
        let texts = |name: &str| {
            let own = elements.iter().filter(|(depth, tag, _)| *depth == 3 && tag == name);
            own.map(|(.., text)| text.clone()).collect::<Vec<_>>()
        };
        let given: Vec<&str> = parameters(module).map(|parameter| parameter.description).collect();
        assert_eq!(texts("description"), given);
    }
}

/// A value that is not the usual one.
fn unusual(kind: &Kind) -> &'static str {
    match kind {
        Kind::File { .. } => "no-such-file",
        Kind::Points => "1,2,3",
        Kind::Number { .. } => "0.5",
        Kind::Integer { .. } => "1",
        Kind::Numbers => "0,1",
        Kind::Choice { among } => among[1],
    }
}

#[test]
fn each_parameter_is_an_option_of_the_command() {
    for module in ALL {
        for parameter in parameters(module) {
            let mut words = vec![module.name, "no-such-input", "out"];
            let option = format!("--{}", parameter.name);
            if !matches!(parameter.kind, Kind::File { position: Some(_), .. }) {
                words.extend([option.as_str(), unusual(&parameter.kind)]);
            }
            let Ok(Request::Run { words, .. }) =
                command_line(module, words.iter().map(OsString::from))
            else {
                panic!("{words:?} is work")
            };
            assert!(words.contains(&parameter.option.into()) || parameter.option.is_empty());
            // There is no such input, but the command gets as far as to see that.
            let failure = heatpath_cli::heatpath(words).unwrap_err().to_string();
            for wrong in ["unexpected argument", "invalid value", "unrecognized"] {
                assert!(!failure.contains(wrong), "{option}: {failure}");
            }
        }
    }
}

#[test]
fn the_usual_is_left_to_the_command() {
    for module in ALL {
        let mut given = vec![OsString::from(module.name), "in".into(), "out".into()];
        for parameter in parameters(module) {
            let usual = match parameter.kind {
                // As nipype and Slicer write numbers.
                Kind::Number { usual } => format!("{usual:.6}"),
                Kind::Integer { usual } => usual.to_string(),
                Kind::Choice { among } => among[0].to_owned(),
                Kind::Numbers => String::new(),
                Kind::File { position: None, channel: Channel::Output, .. } => String::new(),
                Kind::File { .. } | Kind::Points => continue,
            };
            given.extend([format!("--{}", parameter.name).into(), usual.into()]);
        }
        let Ok(Request::Run { words, .. }) = command_line(module, given) else { panic!() };
        let own = module.command.iter().copied();
        let expected = own.chain(["in", "--output", "out", "--quiet", "--force"]);
        assert_eq!(words, expected.map(OsString::from).collect::<Vec<_>>());
    }
}
