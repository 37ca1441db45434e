//! Ensembles that come with the crate: robots that fit the same measurements.

use super::Scene;
use super::error::{Problem, SceneError};

/// Name and text of each robot: that of its ensemble, and its number.
type Robot = (&'static str, u32, &'static str);

/// Robots of an ensemble with these numbers.
macro_rules! robots {
    ($name:literal: $($number:literal)*) => {
        &[$(($name, $number, include_str!(concat!("../../scenes/ensemble/", $name, "-", $number, ".toml")))),*]
    };
}

/// The files of `scenes/ensemble/`, in the order of their numbers.
const ROBOTS: &[Robot] = robots!("paper-3": );

impl Scene {
    /// The robots of an ensemble, in their order. They are of one shape: a batch may hold all of them, see [`crate::Ensemble`].
    ///
    /// # Errors
    /// A name that no ensemble has.
    pub fn ensemble(name: &str) -> Result<Vec<Self>, SceneError> {
        of(ROBOTS, name)
    }
}

fn of(robots: &[Robot], name: &str) -> Result<Vec<Scene>, SceneError> {
    let texts = robots.iter().filter(|(ensemble, ..)| *ensemble == name);
    let scenes = texts.map(|(.., text)| Scene::from_toml(text)).collect::<Result<Vec<_>, _>>()?;
    if scenes.is_empty() {
        let mut names: Vec<&str> = robots.iter().map(|(ensemble, ..)| *ensemble).collect();
        names.dedup();
        let known = if names.is_empty() { "none".into() } else { names.join(", ") };
        return Err(Problem::Ensemble { name: name.into(), known }.into());
    }
    Ok(scenes)
}

#[cfg(test)]
mod tests {
    use super::*;

    const TWO: &[Robot] = &[
        ("three", 1, include_str!("../../scenes/paper-3.toml")),
        ("three", 2, include_str!("../../scenes/paper-3-simulation.toml")),
        ("others", 1, include_str!("../../scenes/paper-5.toml")),
    ];

    #[test]
    fn robots_come_in_their_order_and_names_that_are_not_there_are_told() {
        let names = |name| of(TWO, name).map(|scenes| scenes.into_iter().map(|s| s.name).collect());
        assert_eq!(names("three"), Ok(vec!["paper-3".to_string(), "paper-3-simulation".into()]));
        assert_eq!(
            names("four").unwrap_err().to_string(),
            "there is no ensemble \"four\"; ensembles: three, others"
        );
        assert_eq!(
            of(&[], "three").unwrap_err().to_string(),
            "there is no ensemble \"three\"; ensembles: none"
        );
    }

    /// The list and the folder hold the same robots, numbered from 1.
    #[test]
    fn every_file_is_listed() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/ensemble");
        let entries = std::fs::read_dir(folder).into_iter().flatten();
        let names = entries.map(|entry| entry.expect("a file").file_name().into_string());
        let mut found: Vec<String> = names.map(|name| name.expect("a name of a robot")).collect();
        let mut listed: Vec<String> =
            ROBOTS.iter().map(|(name, k, _)| format!("{name}-{k}.toml")).collect();
        found.sort();
        listed.sort();
        assert_eq!(listed, found);
        for (place, (name, k, _)) in ROBOTS.iter().enumerate() {
            let before = ROBOTS[..place].iter().filter(|(other, ..)| other == name).count();
            assert_eq!(*k as usize, before + 1, "{name}");
        }
    }
}
