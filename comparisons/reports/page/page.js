// The interactive part of the report: a chart with choices, seconds for an equal error, tables that sort, a ledger with
// filters, downloads. The page is complete without it.
(async () => {
  'use strict';
  // results.json, deflated and in base64: a tenth of its size.
  const packed = Uint8Array.from(atob(document.getElementById('results').textContent), (c) => c.charCodeAt(0));
  const results = await new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'))).json();
  const element = (id) => document.getElementById(id);
  const make = (tag, properties = {}, ...children) => {
    const node = Object.assign(document.createElement(tag), properties);
    node.append(...children);
    return node;
  };

  // --- cells, as reports/answers.cc sees them

  const isTarget = (name) => !/log10|slope|_seed_|backward_error|iterations/.test(name);
  const errorOf = (cell, name) => {
    if (cell.status !== 'ok') return null;
    const value = cell.errors[name] ?? cell.quantities[name];
    return typeof value === 'number' && value !== 0 ? Math.abs(value) : null;
  };
  const spacing = (cell) => {
    const counts = /^(\d+)x/.exec(cell.level);
    if (counts && +counts[1] > 1) return 1 / (+counts[1] - 1);
    const length = /^([\d.e+-]+) m/.exec(cell.level);
    if (length) return +length[1];
    if (!cell.n_points) return null;
    return cell.dimension === 1 ? 1 / (cell.n_points - 1) : cell.n_points ** (-1 / (cell.dimension || 2));
  };
  const axes = {
    seconds: { label: 'seconds (median of total)', of: (cell) => cell.seconds.total },
    dofs: { label: 'unknowns', of: (cell) => cell.n_dofs },
    memory: { label: 'peak memory in MB', of: (cell) => cell.memory_bytes / 1e6 },
  };

  const groups = new Map();
  for (const cell of results.cells) {
    // Tables of their own: hard cases have no levels and no cost, linear solvers solve the same system.
    if (cell.benchmark === 'hard_cases' || cell.benchmark === 'solvers') continue;
    const title = [cell.benchmark + (cell.scene ? ' / ' + cell.scene : ''), cell.variant].filter(Boolean).join(', ');
    if (!groups.has(title)) groups.set(title, []);
    groups.get(title).push(cell);
  }
  const rank = (name) => {
    const order = ['displacement_l2_relative', 'stress_l2_relative'];
    const place = order.indexOf(name);
    return place >= 0 ? place : name.includes('stress_concentration') ? 2 : 3;
  };
  const targetsOf = (cells) => {
    const names = new Set();
    for (const cell of cells) {
      for (const name of Object.keys(cell.errors)) if (isTarget(name) && errorOf(cell, name)) names.add(name);
      for (const name of Object.keys(cell.quantities))
        if (isTarget(name) && name.includes('error') && errorOf(cell, name)) names.add(name);
    }
    return [...names].sort((a, b) => rank(a) - rank(b) || (a < b ? -1 : 1));
  };
  const seriesOf = (cells) => {
    const series = new Map();
    for (const cell of cells) {
      if (!series.has(cell.label)) series.set(cell.label, []);
      series.get(cell.label).push(cell);
    }
    for (const members of series.values())
      if (members.every((cell) => spacing(cell))) members.sort((a, b) => spacing(b) - spacing(a));
    return series;
  };

  const scientific = (value) => value.toExponential(3).replace(/e([+-])(\d)$/, 'e$10$2');
  const short = (value) => String(Number(value.toPrecision(3)));

  // Log-log between two neighbouring levels around the target; a reason where there is no answer.
  const secondsFor = (members, name, target) => {
    const points = members.map((cell) => ({ cell, error: errorOf(cell, name), seconds: cell.seconds.total }))
      .filter((point) => point.error && point.seconds > 0);
    if (!points.length) return { reason: members[0].status !== 'ok' ? members[0].status : 'no such error' };
    const errors = points.map((point) => point.error);
    if (Math.max(...errors) < target)
      return { reason: `smaller already: ${scientific(errors[0])} at ${points[0].cell.level} in ${short(points[0].seconds)} s` };
    const least = points.reduce((a, b) => (b.error < a.error ? b : a));
    if (least.error > target) return { reason: `not reached: ${scientific(least.error)} at ${least.cell.level}` };
    if (points.length === 1) return { reason: 'one level only' };
    if (errors.some((error, i) => i > 0 && error > errors[i - 1]))
      return { reason: 'the error does not fall from level to level' };
    const i = errors.findIndex((error, k) => k + 1 < errors.length && error >= target && target >= errors[k + 1]);
    const [a, b] = [points[i], points[i + 1]];
    const failed = members.slice(members.indexOf(a.cell), members.indexOf(b.cell)).find((cell) => cell.status !== 'ok');
    if (failed) return { reason: `${failed.status} at ${failed.level} in between` };
    if (a.error === b.error) return { seconds: Math.min(a.seconds, b.seconds) };
    const weight = Math.log(a.error / target) / Math.log(a.error / b.error);
    return { seconds: a.seconds * (b.seconds / a.seconds) ** weight };
  };

  // --- the chart

  const shapes = ['circle', 'rect', 'triangle', 'rectRot', 'triangle', 'circle', 'rect', 'triangle'];
  const dashes = [[], [7, 3], [2, 3], [8, 3, 2, 3], [12, 4], [4, 2], [2, 2, 8, 2], [1, 4]];
  const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  let chart = null;

  const chosen = () => {
    const cells = groups.get(element('group').value) ?? [];
    const off = new Set([...element('methods').querySelectorAll('input:not(:checked)')].map((box) => box.value));
    const all = [...seriesOf(cells)].map(([label, members], style) => ({ label, members, style }));
    return { name: element('error').value, axis: axes[element('axis').value], series: all.filter((one) => !off.has(one.label)) };
  };

  const dataset = ({ label, members, style }, name, axis) => {
    const k = style % 8;
    const hollow = k >= 5;
    return {
      label,
      data: members.map((cell) => ({ x: axis.of(cell), y: errorOf(cell, name), level: cell.level }))
        .filter((point) => point.x > 0 && point.y > 0),
      borderColor: colour(`--c${k}`),
      backgroundColor: hollow ? colour('--paper') : colour(`--c${k}`),
      pointBorderColor: colour(`--c${k}`),
      pointStyle: shapes[k], rotation: k === 4 ? 180 : 0, pointRadius: 5, pointHoverRadius: 7,
      borderDash: dashes[k], borderWidth: 2, showLine: true,
    };
  };

  // Failed and refused cells as crosses along the upper edge.
  const missing = (series, name, axis, data) => {
    const points = data.flatMap((one) => one.data);
    if (!points.length) return [];
    const top = 1.6 * Math.max(...points.map((point) => point.y));
    const [low, high] = [Math.min(...points.map((p) => p.x)), Math.max(...points.map((p) => p.x))];
    const cells = series.flatMap((one) => one.members.filter((cell) => cell.status !== 'ok').map((cell) => ({ cell, style: one.style })));
    return cells.map(({ cell, style }, i) => ({
      label: `${cell.label}, ${cell.level}: ${cell.status}`,
      reason: cell.reason,
      data: [{ x: cell.n_dofs > 0 && axis === axes.dofs ? cell.n_dofs : low * (high / low) ** ((i + 1) / (cells.length + 1)), y: top, level: cell.level }],
      pointStyle: 'crossRot', pointRadius: 7, borderColor: colour(`--c${style % 8}`), borderWidth: 2, showLine: false,
    }));
  };

  const drawChart = () => {
    const { name, axis, series } = chosen();
    const data = series.map((one) => dataset(one, name, axis)).filter((one) => one.data.length);
    const crosses = missing(series, name, axis, data);
    element('not-drawn').replaceChildren(...series.flatMap((one) => one.members).filter((cell) => cell.status !== 'ok')
      .map((cell) => make('li', { textContent: `\u00d7 ${cell.label}, ${cell.level}: ${cell.status}${cell.reason ? ': ' + cell.reason : ''}` })));
    if (typeof Chart === 'undefined') return;
    const scale = (text) => ({
      type: 'logarithmic', title: { display: true, text, color: colour('--ink') },
      grid: { color: colour('--line') },
      // Only powers of ten have a label: the others would be lines that say nothing.
      afterBuildTicks: (axis) => {
        const powers = axis.ticks.filter((tick) => Math.abs(Math.log10(tick.value) % 1) < 1e-9);
        if (powers.length > 1) axis.ticks = powers;
      },
      ticks: { color: colour('--ink'), maxTicksLimit: 9, callback: (value) => (Math.abs(Math.log10(value) % 1) < 1e-9 ? value.toExponential(0) : short(value)) },
    });
    if (chart) chart.destroy();
    chart = new Chart(element('chart'), {
      type: 'scatter',
      data: { datasets: [...data, ...crosses] },
      options: {
        responsive: true, maintainAspectRatio: false, animation: false,
        scales: { x: scale(axis.label), y: scale(name.replaceAll('_', ' ')) },
        interaction: { mode: 'nearest', intersect: false },
        plugins: {
          legend: { labels: { color: colour('--ink'), usePointStyle: true, filter: (item) => item.datasetIndex < data.length } },
          tooltip: { callbacks: { label: (item) => item.dataset.reason !== undefined
            ? [item.dataset.label, ...(item.dataset.reason.match(/.{1,60}(\s|$)/g) ?? [])]
            : `${item.dataset.label}, ${item.raw.level}: ${short(item.raw.x)}, ${scientific(item.raw.y)}` } },
        },
      },
    });
  };

  // --- seconds for an equal error

  const fillEqual = () => {
    const { name, series } = chosen();
    const target = 10 ** Number(element('target').value);
    element('target-value').textContent = scientific(target) + (name.includes('relative') ? ` (${short(100 * target)} %)` : '');
    element('target').setAttribute('aria-valuetext', element('target-value').textContent);
    const rows = series.map((one) => ({ label: one.label, ...secondsFor(one.members, name, target) }));
    rows.sort((a, b) => (a.seconds ?? Infinity) - (b.seconds ?? Infinity) || 0);
    const best = rows.find((row) => row.seconds)?.seconds;
    element('equal').tBodies[0].replaceChildren(...rows.map((row) => make('tr', {},
      make('th', { scope: 'row', className: 'p', textContent: row.label }),
      make('td', { textContent: row.seconds ? short(row.seconds) : '-' }),
      make('td', { textContent: row.seconds ? short(row.seconds / best) : '-' }),
      make('td', { className: 'p', textContent: row.reason ?? '' }))));
  };

  const setRange = () => {
    const { name, series } = chosen();
    const errors = series.flatMap((one) => one.members.map((cell) => errorOf(cell, name))).filter(Boolean);
    const slider = element('target');
    slider.disabled = !errors.length;
    if (!errors.length) return;
    slider.min = Math.floor(Math.log10(Math.min(...errors)) * 10) / 10;
    slider.max = Math.ceil(Math.log10(Math.max(...errors)) * 10) / 10;
    const inside = Number(slider.min) <= -2 && Number(slider.max) >= -2;
    slider.value = inside ? -2 : (Number(slider.min) + Number(slider.max)) / 2;
  };

  const update = () => { setRange(); drawChart(); fillEqual(); };

  const chooseGroup = () => {
    const cells = groups.get(element('group').value);
    element('error').replaceChildren(...targetsOf(cells).map((name) => new Option(name.replaceAll('_', ' '), name)));
    const labels = [...seriesOf(cells).keys()];
    element('methods').replaceChildren(element('methods').querySelector('legend'), ...labels.map((label, style) =>
      make('label', {}, make('input', { type: 'checkbox', checked: true, value: label }), make('span', { className: `c${style % 8}`, textContent: '\u25a0', ariaHidden: 'true' }), label)));
    update();
  };

  const startExplorer = () => {
    const useful = [...groups].filter(([, cells]) => targetsOf(cells).length);
    if (!useful.length) return;
    element('group').replaceChildren(...useful.map(([title]) => new Option(title, title)));
    // First the one that has most to compare.
    const weight = ([, cells]) => new Set(cells.map((cell) => cell.level)).size > 1 ? cells.length : 0;
    element('group').value = useful.reduce((a, b) => (weight(b) > weight(a) ? b : a))[0];
    element('explore').hidden = false;
    element('no-chart').hidden = typeof Chart !== 'undefined';
    element('chart-frame').hidden = typeof Chart === 'undefined';
    element('choices').addEventListener('submit', (event) => event.preventDefault());
    element('group').addEventListener('change', chooseGroup);
    element('error').addEventListener('change', update);
    element('axis').addEventListener('change', drawChart);
    element('methods').addEventListener('change', () => { drawChart(); fillEqual(); });
    element('target').addEventListener('input', fillEqual);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', drawChart);
    chooseGroup();
  };

  // --- tables that sort

  const sortKey = (text) => {
    const number = Number.parseFloat(text);
    return text === '-' || text === '' ? null : Number.isNaN(number) ? text : number;
  };
  const sortTable = (table, column, header) => {
    const ascending = header.getAttribute('aria-sort') !== 'ascending';
    for (const other of table.tHead.rows[0].cells) other.removeAttribute('aria-sort');
    header.setAttribute('aria-sort', ascending ? 'ascending' : 'descending');
    const rows = [...table.tBodies[0].rows].map((row) => ({ row, key: sortKey(row.cells[column].textContent) }));
    rows.sort((a, b) => {
      if (a.key === null || b.key === null) return (a.key === null) - (b.key === null); // dashes last
      const order = typeof a.key === 'number' && typeof b.key === 'number' ? a.key - b.key : String(a.key).localeCompare(String(b.key));
      return ascending ? order : -order;
    });
    table.tBodies[0].append(...rows.map((entry) => entry.row));
  };
  const startSorting = () => {
    for (const table of document.querySelectorAll('main table:not(#equal)'))
      [...table.tHead.rows[0].cells].forEach((header, column) => {
        const button = make('button', { type: 'button', textContent: header.textContent });
        button.addEventListener('click', () => sortTable(table, column, header));
        header.replaceChildren(button);
      });
  };

  // --- the ledger

  const startLedger = () => {
    const section = document.getElementById('published-numbers-and-claims');
    if (!section) return;
    const rows = [...section.querySelectorAll('table')].flatMap((table) => {
      const heads = [...table.tHead.rows[0].cells].map((cell) => cell.textContent);
      const verdict = heads.indexOf('verdict');
      return [...table.tBodies[0].rows].map((row) => ({
        row, source: table.caption.textContent, verdict: row.cells[verdict].textContent, text: row.textContent.toLowerCase(),
      }));
    });
    const options = (key) => ['all', ...new Set(rows.map((entry) => entry[key]))].map((text) => new Option(text, text));
    const source = make('select', { id: 'ledger-source' }, ...options('source'));
    const verdict = make('select', { id: 'ledger-verdict' }, ...options('verdict'));
    const words = make('input', { id: 'ledger-words', type: 'search' });
    const count = make('output', { id: 'ledger-count' });
    const filter = () => {
      let n = 0;
      for (const entry of rows) {
        const shown = (source.value === 'all' || entry.source === source.value) && (verdict.value === 'all' || entry.verdict === verdict.value)
          && entry.text.includes(words.value.toLowerCase());
        entry.row.hidden = !shown;
        n += shown;
      }
      count.textContent = `${n} of ${rows.length} entries`;
    };
    const bar = make('div', { className: 'filters' }, make('label', {}, 'Source', source), make('label', {}, 'Verdict', verdict),
      make('label', {}, 'Words', words), count);
    section.querySelector('h2').after(bar);
    bar.addEventListener('input', filter);
    filter();
  };

  // --- downloads

  const csvField = (value) => {
    const text = value === null || value === undefined ? '' : String(value);
    return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
  };
  // The columns and rows of results.csv.
  const csv = () => {
    const lines = [['benchmark', 'scene', 'variant', 'method', 'label', 'level', 'n_points', 'n_dofs', 'status', 'expected', 'reason', 'kind', 'quantity', 'value']];
    for (const cell of results.cells) {
      const front = [cell.benchmark, cell.scene, cell.variant, cell.method, cell.label, cell.level, cell.n_points, cell.n_dofs, cell.status, cell.expected, cell.reason];
      const add = (kind, quantity, value) => lines.push([...front, kind, quantity, value]);
      if (cell.status !== 'ok') { add('none', '', ''); continue; }
      for (const [name, value] of Object.entries(cell.errors)) add('error', name, value);
      for (const [name, value] of Object.entries(cell.quantities)) add('quantity', name, value);
      for (const phase of Object.keys(cell.seconds.minimum)) {
        add('seconds', phase, cell.seconds[phase]);
        add('seconds_minimum', phase, cell.seconds.minimum[phase]);
        add('seconds_maximum', phase, cell.seconds.maximum[phase]);
      }
      add('size', 'repeats', cell.seconds.repeats);
      for (const name of ['steps', 'memory_bytes', 'nonzeros']) add('size', name, cell[name]);
    }
    return lines.map((line) => line.map(csvField).join(',') + '\n').join('');
  };
  const download = (name, type, text) => {
    const link = make('a', { href: URL.createObjectURL(new Blob([text], { type })), download: name });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  };
  const startDownloads = () => {
    element('download-json').addEventListener('click', () => download('results.json', 'application/json', JSON.stringify(results, null, 2) + '\n'));
    element('download-csv').addEventListener('click', () => download('results.csv', 'text/csv', csv()));
  };

  for (const node of document.querySelectorAll('.scripted')) node.hidden = false;
  startExplorer();
  startSorting();
  startLedger();
  startDownloads();
  document.documentElement.dataset.ready = 'yes';
})();
