//! Law: what is stored comes back the same, and what could not have been stored is refused.
#![cfg(feature = "serde")]

use steradian::sprt::{Bernoulli, Bounds, Looks, Run, Sprt};

type Failure = Box<dyn std::error::Error>;

fn test() -> Result<Sprt<Bernoulli>, Failure> {
    let test = Sprt::new(Bernoulli::new(0.1, 0.3)?, Bounds::from_risks(0.05, 0.1)?);
    Ok(test.looks(Looks::from(10).every(2)).truncate(64))
}

#[test]
fn a_run_can_be_put_away_and_taken_up() -> Result<(), Failure> {
    let outcomes = [1, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 1, 1, 1].map(|outcome| outcome == 1);
    for cut in 0..=outcomes.len() {
        let mut whole = test()?.start();
        whole.extend(outcomes[..cut].iter().copied());
        let mut restored: Run<Bernoulli> = serde_json::from_str(&serde_json::to_string(&whole)?)?;
        // The next look of a run that has stopped is not kept; nothing depends on it.
        assert_eq!(
            (restored.step(), restored.samples(), restored.successes()),
            (whole.step(), whole.samples(), whole.successes())
        );
        for outcome in &outcomes[cut..] {
            assert_eq!(restored.push(*outcome), whole.push(*outcome), "cut at {cut}");
        }
    }
    Ok(())
}

#[test]
fn a_test_comes_back_the_same() -> Result<(), Failure> {
    for test in [test()?, Sprt::new(Bernoulli::new(0.9, 0.2)?, Bounds::from_ratios(3.0, 0.5)?)] {
        let text = serde_json::to_string(&test)?;
        assert_eq!(serde_json::from_str::<Sprt<Bernoulli>>(&text)?, test, "{text}");
    }
    Ok(())
}

#[test]
fn what_could_not_have_been_stored_is_refused() -> Result<(), Failure> {
    assert!(serde_json::from_str::<Bernoulli>(r#"{"p0":0.5,"p1":0.5}"#).is_err());
    assert!(serde_json::from_str::<Bounds>(r#"{"risks":{"alpha":0.5,"beta":0.5}}"#).is_err());
    assert_eq!(serde_json::from_str::<Looks>(r#"{"first":0,"step":0}"#)?, Looks::default());
    let mut run = serde_json::to_value(test()?.start())?;
    for (samples, successes, step) in [
        (3, 4, r#""Continue""#),
        (64, 12, r#""Continue""#),
        (12, 12, r#""Continue""#),
        (12, 12, r#"{"Stop":"AcceptH0"}"#),
        (4, 4, r#"{"Stop":"RejectH0"}"#),
        (63, 10, r#""Exhausted""#),
    ] {
        run["samples"] = samples.into();
        run["successes"] = successes.into();
        run["step"] = serde_json::from_str(step)?;
        assert!(serde_json::from_value::<Run<Bernoulli>>(run.clone()).is_err(), "{run}");
    }
    Ok(())
}
