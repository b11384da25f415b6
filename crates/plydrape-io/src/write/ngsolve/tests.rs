use super::*;
use crate::sample;
use serde_json::Value;

fn data(result: &ResultFile) -> Value {
    let files = files(result, None, None).unwrap();
    serde_json::from_slice(&files[1].1).unwrap()
}

fn reals(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}
