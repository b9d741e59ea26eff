// The page of a proposal: everything that it shows stands in it as JSON, so that it needs no network.
import "../english";
import { JSX, render } from "preact";
import { useMemo, useState } from "preact/hooks";
import { cut_shapes } from "./cut";
import type { Proposal } from "./data";
import { Model } from "./model";
import { Plans } from "./plans";
import { Buildings, Indicators, OpenSpaces, Plots, Programme, Storeys } from "./tables";

const kParts: [string, string][] = [
  ["model", "Model"],
  ["plans", "Plans"],
  ["areas", "Areas"],
  ["conflicts", "Conflicts"],
  ["about", "About"],
];

function Conflicts({ proposal }: { proposal: Proposal }): JSX.Element {
  const { conflicts, minor_conflicts, troubles } = proposal;
  return (
    <>
      {conflicts.length === 0 ? <p>Nobody pulls at the same thing in different directions.</p> : null}
      <ol class="story">
        {conflicts.map((one) => (
          <li key={`${one.node} ${one.port}`}>
            <h3>
              {one.node}: {one.port}
            </h3>
            <p>Apart by {one.tension}.</p>
            <ul>
              {one.pulls.map((pull) => (
                <li key={pull}>{pull}</li>
              ))}
            </ul>
          </li>
        ))}
      </ol>
      {minor_conflicts > 0 ? <p class="small">{minor_conflicts} more are too small to be told.</p> : null}
      {troubles.length > 0 ? <h3>What is not met, or fails</h3> : null}
      <ul class="story">
        {troubles.map((one) => (
          <li key={`${one.place} ${one.message}`}>
            <b>{one.place}</b>: {one.message}
          </li>
        ))}
      </ul>
    </>
  );
}

function Page({ proposal }: { proposal: Proposal }): JSX.Element {
  const [chosen, choose] = useState<string | null>(null),
    [level, setLevel] = useState(0),
    [isCut, setCut] = useState(false);
  const shapes = useMemo(() => (isCut ? cut_shapes(proposal, level) : proposal.shapes), [isCut, level]);
  const building = proposal.buildings.find((one) => one.id === chosen);
  return (
    <>
      <header>
        <h1>{proposal.title}</h1>
        {proposal.about ? <p class="lead">{proposal.about}</p> : null}
        {proposal.settled ? null : <p class="notice">The scene had not settled: figures may still have been moving.</p>}
        <nav aria-label="Parts of the page">
          {kParts.map(([id, name]) => (
            <a key={id} href={`#${id}`}>
              {name}
            </a>
          ))}
        </nav>
      </header>
      <main>
        <div class="drawings">
          <section id="model" aria-labelledby="model_title">
            <h2 id="model_title">Model</h2>
            <Model proposal={proposal} shapes={shapes} chosen={chosen} choose={choose} />
            <p class="small" role="status">
              {building ? `Chosen: ${building.name}` : "A touch on a building, or its name in the table, chooses it."}
            </p>
          </section>
          <section id="plans" aria-labelledby="plans_title">
            <h2 id="plans_title">Plans by level</h2>
            <Plans proposal={proposal} chosen={chosen} choose={choose} level={level} setLevel={setLevel} isCut={isCut} setCut={setCut} />
          </section>
        </div>
        <section id="areas" aria-labelledby="areas_title">
          <h2 id="areas_title">Programme against result</h2>
          <Programme proposal={proposal} />
          {proposal.open.length > 0 ? <OpenSpaces proposal={proposal} /> : null}
          {proposal.indicators.length > 0 ? (
            <>
              <h2>Indicators</h2>
              <Indicators indicators={proposal.indicators} />
            </>
          ) : null}
          <h2>Buildings</h2>
          <Buildings proposal={proposal} chosen={chosen} choose={choose} />
          {proposal.plots.length > 0 ? (
            <>
              <h2>Plots</h2>
              <Plots proposal={proposal} />
            </>
          ) : null}
          <details>
            <summary>Areas of all storeys</summary>
            <Storeys proposal={proposal} />
          </details>
        </section>
        <section id="conflicts" aria-labelledby="conflicts_title">
          <h2 id="conflicts_title">Conflicts, the worst first</h2>
          <Conflicts proposal={proposal} />
        </section>
        <section id="about" aria-labelledby="about_title">
          <h2 id="about_title">About this page</h2>
          <dl>
            {proposal.identity.map(([name, value]) => (
              <div key={name}>
                <dt>{name.replace(/_/g, " ")}</dt>
                <dd>{value}</dd>
              </div>
            ))}
          </dl>
        </section>
      </main>
    </>
  );
}

const root = document.getElementById("page"),
  data = document.getElementById("data")?.textContent ?? "";
if (root) render(<Page proposal={JSON.parse(data) as Proposal} />, root);
