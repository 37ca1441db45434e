//! What a case measured, against what, and within which band. A band that is reported is the band that is
//! asserted: both come from the one number that a case gives here. With `MAGWORM_VALIDATION_DIR` set, each case
//! also leaves a TOML file there, from which `studies/validation` writes the page.

use serde::Serialize;
use std::ops::RangeInclusive;
use std::path::Path;

/// Folder for the files of the cases; unset, a case only prints.
const FOLDER: &str = "MAGWORM_VALIDATION_DIR";

/// One case of validation: where it comes from and what it gave.
#[derive(Serialize)]
pub struct Case {
    name: &'static str,
    /// The test's whole name.
    test: String,
    title: &'static str,
    equation: String,
    source: String,
    /// A preset's name or a scene's text, and its edits in TOML.
    base: String,
    edits: Vec<String>,
    note: String,
    rows: Vec<Row>,
    tables: Vec<Table>,
    figures: Vec<Figure>,
}

/// A measured value and what it may be. `low` and `high` bound the size of the error where there is one,
/// otherwise the value itself; rows without a bound have infinite ones.
#[derive(Serialize)]
struct Row {
    quantity: String,
    unit: &'static str,
    measured: Vec<f64>,
    expected: Vec<f64>,
    /// Median, 90 % quantile and greatest of many errors, and how many they are.
    quantiles: Vec<f64>,
    error: Option<f64>,
    /// The error's unit, `relative` or `of …`.
    error_unit: &'static str,
    low: f64,
    high: f64,
    within: bool,
}

/// Values that explain a case and have no band.
#[derive(Serialize)]
struct Table {
    caption: String,
    head: Vec<String>,
    rows: Vec<Vec<String>>,
}

/// How the axes of a figure are divided.
#[derive(Clone, Copy, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Axes {
    Linear,
    /// Linear with equal scales, for shapes.
    Equal,
    LogLog,
}

/// A plot.
#[derive(Serialize)]
pub struct Figure {
    title: String,
    x: &'static str,
    y: &'static str,
    axes: Axes,
    /// Slope of a dashed line to compare with, in logarithmic axes.
    slope: Option<f64>,
    curves: Vec<Curve>,
}

/// A curve of the reference, or points of the simulator.
#[derive(Serialize)]
struct Curve {
    label: String,
    exact: bool,
    x: Vec<f64>,
    y: Vec<f64>,
}

impl Figure {
    pub fn new(title: &str, x: &'static str, y: &'static str, axes: Axes) -> Self {
        Self { title: title.into(), x, y, axes, slope: None, curves: Vec::new() }
    }

    /// Adds a dashed line of this slope.
    pub fn slope(mut self, slope: f64) -> Self {
        self.slope = Some(slope);
        self
    }

    /// Adds what the simulator gave.
    pub fn points(&mut self, label: impl Into<String>, points: impl IntoIterator<Item = [f64; 2]>) {
        self.add(label.into(), false, points);
    }

    /// Adds the reference.
    pub fn exact(&mut self, label: impl Into<String>, points: impl IntoIterator<Item = [f64; 2]>) {
        self.add(label.into(), true, points);
    }

    fn add(&mut self, label: String, exact: bool, points: impl IntoIterator<Item = [f64; 2]>) {
        let (x, y) = points.into_iter().map(|[x, y]| (x, y)).unzip();
        self.curves.push(Curve { label, exact, x, y });
    }
}

impl Case {
    /// A comparison with something from outside; `name` is that of the test function less `validates_`.
    pub fn new(name: &'static str, title: &'static str) -> Self {
        Self::of("validates", name, title)
    }

    /// Numbers that the presets were fitted to, which say that the fit still holds and no more; `name` is that of the test
    /// function less `regresses_`.
    pub fn fitted(name: &'static str, title: &'static str) -> Self {
        Self::of("regresses", name, title)
    }

    fn of(kind: &str, name: &'static str, title: &'static str) -> Self {
        Self {
            name,
            test: format!("{kind}_{name}"),
            title,
            equation: String::new(),
            source: String::new(),
            base: String::new(),
            edits: Vec::new(),
            note: String::new(),
            rows: Vec::new(),
            tables: Vec::new(),
            figures: Vec::new(),
        }
    }

    /// The law that the case checks.
    pub fn equation(mut self, text: &str) -> Self {
        self.equation = text.into();
        self
    }

    /// Where the law or the number is published.
    pub fn source(mut self, text: &str) -> Self {
        self.source = text.into();
        self
    }

    /// What a reader must know besides: method, where the error comes from, what is not covered.
    pub fn note(mut self, text: &str) -> Self {
        self.note = text.into();
        self
    }

    /// The scene: a preset or the text of `world::ROD`, and the edits of it; `…` for values that vary.
    pub fn scene(mut self, base: &str, edits: &[(&str, &str)]) -> Self {
        self.base = base.into();
        self.edits = edits
            .iter()
            .map(|(path, value)| match *value {
                "" => format!("# without {path}"),
                value => format!("{path} = {value}"),
            })
            .collect();
        self
    }

    /// A value against an expected one; `band` bounds the error as a part of the expected value.
    pub fn relative(
        &mut self,
        quantity: impl Into<String>,
        unit: &'static str,
        [measured, expected]: [f64; 2],
        band: f64,
    ) {
        let error = measured / expected - 1.0;
        let both = [vec![measured], vec![expected]];
        self.push(quantity.into(), unit, both, Some((error, "relative")), 0.0..=band);
    }

    /// A value against an expected one; `band` bounds the difference, in the row's unit.
    pub fn absolute(
        &mut self,
        quantity: impl Into<String>,
        unit: &'static str,
        [measured, expected]: [f64; 2],
        band: f64,
    ) {
        let error = measured - expected;
        let both = [vec![measured], vec![expected]];
        self.push(quantity.into(), unit, both, Some((error, unit)), 0.0..=band);
    }

    /// A point against an expected one; `band` bounds their distance, in the row's unit. Infinite: told only.
    pub fn place(
        &mut self,
        quantity: impl Into<String>,
        unit: &'static str,
        [measured, expected]: [[f64; 2]; 2],
        band: f64,
    ) {
        let error = (measured[0] - expected[0]).hypot(measured[1] - expected[1]);
        let both = [measured.to_vec(), expected.to_vec()];
        self.push(quantity.into(), unit, both, Some((error, unit)), 0.0..=band);
    }

    /// A value that must lie in a range, with one infinite end or none.
    pub fn inside(
        &mut self,
        quantity: impl Into<String>,
        unit: &'static str,
        measured: f64,
        band: RangeInclusive<f64>,
    ) {
        self.push(quantity.into(), unit, [vec![measured], vec![]], None, band);
    }

    /// A value that must not exceed a bound.
    pub fn at_most(
        &mut self,
        quantity: impl Into<String>,
        unit: &'static str,
        measured: f64,
        bound: f64,
    ) {
        self.inside(quantity, unit, measured, f64::NEG_INFINITY..=bound);
    }

    /// A value without a band.
    pub fn tell(&mut self, quantity: impl Into<String>, unit: &'static str, measured: f64) {
        self.inside(quantity, unit, measured, f64::NEG_INFINITY..=f64::INFINITY);
    }

    /// Many errors: `band` bounds the size of the greatest, in `error_unit`. Infinite: told only.
    pub fn spread(
        &mut self,
        quantity: impl Into<String>,
        error_unit: &'static str,
        errors: &[f64],
        band: f64,
    ) {
        let mut sizes: Vec<f64> = errors.iter().map(|error| error.abs()).collect();
        sizes.sort_by(f64::total_cmp);
        let at = |share: f64| sizes[((sizes.len() - 1) as f64 * share).round() as usize];
        let quantiles = vec![at(0.5), at(0.9), at(1.0), sizes.len() as f64];
        let error = Some((at(1.0), error_unit));
        self.push(quantity.into(), "", [vec![], vec![]], error, 0.0..=band);
        if let Some(row) = self.rows.last_mut() {
            row.quantiles = quantiles;
        }
    }

    fn push(
        &mut self,
        quantity: String,
        unit: &'static str,
        [measured, expected]: [Vec<f64>; 2],
        error: Option<(f64, &'static str)>,
        band: RangeInclusive<f64>,
    ) {
        let (low, high) = band.into_inner();
        let bounded = error.map_or_else(|| measured[0], |(error, _)| error.abs());
        // Not a number is outside of every band.
        let within = bounded >= low && bounded <= high;
        println!("{}: {quantity}: {measured:?} {unit}, error {error:?}", self.name);
        let (error, error_unit) = error.unzip();
        let error_unit = error_unit.unwrap_or_default();
        let quantiles = Vec::new();
        self.rows.push(Row {
            quantity,
            unit,
            measured,
            expected,
            quantiles,
            error,
            error_unit,
            low,
            high,
            within,
        });
    }

    /// A table without bands.
    pub fn table(&mut self, caption: &str, head: &[&str], rows: Vec<Vec<String>>) {
        let head = head.iter().map(|cell| (*cell).into()).collect();
        self.tables.push(Table { caption: caption.into(), head, rows });
    }

    pub fn figure(&mut self, figure: Figure) {
        self.figures.push(figure);
    }

    /// Leaves the case's file, then fails where a row is outside of its band.
    pub fn finish(self) {
        if let Some(folder) = std::env::var_os(FOLDER) {
            let text = toml::to_string(&self).expect("a case is TOML");
            let path = Path::new(&folder).join(format!("{}.toml", self.name));
            std::fs::write(&path, text).expect("the folder of the cases can be written");
        }
        let outside: Vec<&str> =
            self.rows.iter().filter(|row| !row.within).map(|row| row.quantity.as_str()).collect();
        assert!(outside.is_empty(), "{}: outside of the band: {outside:?}", self.name);
    }
}

/// Orders of convergence between meshes or steps, each half as coarse as the one before.
pub fn orders(errors: &[f64]) -> Vec<f64> {
    errors.windows(2).map(|pair| (pair[0] / pair[1]).abs().log2()).collect()
}

/// Of several orders the one farthest from what is expected.
pub fn farthest_from(expected: f64, orders: &[f64]) -> f64 {
    let distance = |order: &f64| (order - expected).abs();
    let farthest = orders.iter().max_by(|a, b| distance(a).total_cmp(&distance(b)));
    *farthest.expect("two meshes or steps")
}

/// A number as a table shows it.
pub fn short(value: f64) -> String {
    format!("{value:.1e}")
}
