// page_test.mjs PAGE RESULTS [SCREENSHOTS]: the report page in a real Chromium, opened from its file. Writes one line a
// check and ends with 1 if one failed.
import { readFileSync, mkdtempSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { chromium } from 'playwright-core';

const [page_file, results_file, screenshots] = process.argv.slice(2);
const url = 'file://' + resolve(page_file);
const results = JSON.parse(readFileSync(results_file, 'utf8'));
const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
const flags = ['--headless', '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run',
  '--disable-background-networking', '--disable-component-update', '--disable-sync'];

let n_failed = 0;
const check = (holds, what, found = '') => {
  console.log(`${holds ? 'ok    ' : 'FAILED'} ${what}${holds || found === '' ? '' : ': found ' + JSON.stringify(found)}`);
  if (!holds) n_failed += 1;
};

// One browser a set of options: a new profile each, removed afterwards.
const with_page = async (options, visit) => {
  const profile = mkdtempSync(join(tmpdir(), 'petrov_page_'));
  const context = await chromium.launchPersistentContext(profile, {
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: flags, headless: true,
    viewport: { width: 1280, height: 900 }, acceptDownloads: true, ...options,
  });
  try {
    const page = await context.newPage();
    const problems = [];
    page.on('console', (message) => { if (['error', 'warning'].includes(message.type())) problems.push(message.text()); });
    page.on('pageerror', (error) => problems.push(String(error)));
    page.on('request', (request) => { if (!/^(file|data|blob):/.test(request.url())) problems.push('asked the network for ' + request.url()); });
    await page.goto(url);
    await visit(page, problems);
  } finally {
    await context.close();
    rmSync(profile, { recursive: true, force: true });
  }
};
const ready = (page) => page.waitForSelector('html[data-ready=yes]', { timeout: 20000, state: 'attached' });
// Colours of the chart that are not the paper: it was drawn.
const chart_pixels = (page) => page.evaluate(() => {
  const canvas = document.getElementById('chart');
  const data = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
  let n = 0;
  for (let i = 3; i < data.length; i += 4) n += data[i] > 0 ? 1 : 0;
  return n;
});
const chart_data = (page) => page.evaluate(() => JSON.stringify(Chart.getChart('chart').data.datasets.map((d) => d.data)));
const accessible = async (page, what) => {
  await page.evaluate(axe);
  const found = await page.evaluate(async () => (await axe.run(document)).violations
    .filter((v) => ['serious', 'critical'].includes(v.impact)).map((v) => `${v.id}: ${v.nodes.length} x ${v.nodes[0].html.slice(0, 120)} ${v.nodes[0].failureSummary}`));
  check(found.length === 0, `axe finds nothing serious, ${what}`, found);
};
const shoot = async (page, name) => { if (screenshots) await page.screenshot({ path: join(screenshots, name + '.png') }); };

await with_page({}, async (page, problems) => {
  await ready(page);
  check(problems.length === 0, 'no console message and no request over the network', problems);
  check(await page.isVisible('#explore'), 'the explorer is shown');
  check(await chart_pixels(page) > 2000, 'the chart is drawn');
  const before = await chart_data(page);
  const errors = await page.$$eval('#error option', (options) => options.map((option) => option.value));
  check(errors.length > 1, 'there is a choice of errors', errors);
  await page.selectOption('#error', errors[1]);
  const after = await chart_data(page);
  check(before !== after, 'another error norm changes the data');
  await page.selectOption('#error', errors[0]);
  check(before === await chart_data(page), 'and back');
  await page.selectOption('#axis', 'memory');
  check(before !== await chart_data(page), 'another axis changes the data');
  await page.selectOption('#axis', 'seconds');
  const boxes = await page.$$('#methods input');
  await boxes[0].uncheck();
  const n_rows = (await page.$$('#equal tbody tr')).length;
  check(n_rows === boxes.length - 1, 'a method that is not chosen leaves the table', n_rows);
  await boxes[0].check();

  // The slider and the table of results.json agree.
  const group = await page.inputValue('#group');
  const entries = results.equal_error.filter((entry) => entry.error === errors[0]
    && [`${entry.benchmark} / ${entry.scene}`, entry.variant].filter(Boolean).join(', ') === group);
  check(entries.length > 0, 'the group shown first has equal errors');
  const tables = new Set();
  for (const target of new Set(entries.map((entry) => entry.target))) {
    await page.$eval('#target', (slider, value) => {
      slider.value = value;
      slider.dispatchEvent(new Event('input', { bubbles: true }));
    }, Math.log10(target));
    const shown = await page.$$eval('#equal tbody tr', (rows) => rows.map((row) => [...row.cells].map((cell) => cell.textContent)));
    tables.add(JSON.stringify(shown));
    for (const entry of entries.filter((one) => one.target === target)) {
      const row = shown.find((cells) => cells[0] === entry.method);
      const same = entry.seconds === null ? row[1] === '-' : Math.abs(Number(row[1]) / entry.seconds - 1) < 0.006; // three digits
      check(same, `${entry.method} for ${target}: as in results.json`, [row, entry.seconds]);
    }
  }
  check(tables.size > 1, 'the slider changes the table of equal errors');
  // By keyboard.
  await page.focus('#target');
  const value = await page.inputValue('#target');
  await page.keyboard.press('ArrowRight');
  check(value !== await page.inputValue('#target'), 'the slider moves by the keyboard');

  // Values on hovering.
  const place = await page.evaluate(() => {
    const chart = Chart.getChart('chart');
    const point = chart.getDatasetMeta(0).data[0];
    const frame = chart.canvas.getBoundingClientRect();
    chart.canvas.scrollIntoView({ block: 'center' });
    const moved = chart.canvas.getBoundingClientRect();
    return { x: moved.left + point.x, y: moved.top + point.y, height: frame.height };
  });
  await page.mouse.move(place.x, place.y);
  await page.waitForTimeout(200);
  const tip = await page.evaluate(() => Chart.getChart('chart').tooltip.body?.map((one) => one.lines.join(' ')).join(' ') ?? '');
  check(/\d/.test(tip), 'hovering tells the values', tip);

  // Sorting.
  const table = '#comparison table >> nth=0';
  const heads = await page.$$eval('#comparison table', (all) => [...all[0].tHead.rows[0].cells].map((cell) => cell.textContent));
  const j = heads.findIndex((head) => head.startsWith('total'));
  const unsorted = await page.$$eval('#comparison table', (all, k) => [...all[0].tBodies[0].rows].map((row) => row.cells[k].textContent), j);
  await page.locator(table).locator('thead button').nth(j).click();
  const sorted = await page.$$eval('#comparison table', (all, k) => [...all[0].tBodies[0].rows].map((row) => row.cells[k].textContent), j);
  const numbers = sorted.filter((text) => text !== '-').map(Number);
  check(numbers.length > 1 && numbers.every((number, i) => i === 0 || numbers[i - 1] <= number), 'a click sorts by numbers', sorted);
  await page.locator(table).locator('thead button').nth(j).press('Enter');
  const reversed = await page.$$eval('#comparison table', (all, k) => [...all[0].tBodies[0].rows].map((row) => row.cells[k].textContent), j);
  check(Number(reversed[0]) === numbers.at(-1), 'Enter sorts the other way', reversed);
  check([...unsorted].sort().join() === [...sorted].sort().join(), 'no row is lost by sorting');

  // The ledger.
  if (results.published.length) {
    const all = await page.$$eval('#published-numbers-and-claims tbody tr', (rows) => rows.filter((row) => !row.hidden).length);
    check(all === results.published.length, 'the ledger has every entry', all);
    const shown_as = (entry) => entry.verdict + (!entry.expected ? ' (UNEXPECTED)' : ['reproduced', 'holds'].includes(entry.verdict) ? '' : ' (expected)');
    const verdict = shown_as(results.published[0]);
    await page.selectOption('#ledger-verdict', verdict);
    const n = await page.$$eval('#published-numbers-and-claims tbody tr', (rows) => rows.filter((row) => !row.hidden).length);
    check(n === results.published.filter((entry) => shown_as(entry) === verdict).length, 'the ledger is filtered by verdict', n);
    await page.fill('#ledger-words', 'no entry has these words');
    check(await page.textContent('#ledger-count') === `0 of ${results.published.length} entries`, 'and by words');
    await page.fill('#ledger-words', '');
    await page.selectOption('#ledger-verdict', 'all');
  }

  // Downloads.
  for (const [button, parse] of [['json', (text) => JSON.parse(text)], ['csv', (text) => text]]) {
    const [download] = await Promise.all([page.waitForEvent('download'), page.click('#download-' + button)]);
    const text = readFileSync(await download.path(), 'utf8');
    const whole = button === 'json' ? JSON.stringify(parse(text)) === JSON.stringify(results)
      : parse(text).split('\n').length - 1 > results.cells.length;
    check(whole, `the page gives results.${button}`);
  }
  const bad = results.cells.filter((cell) => cell.status !== 'ok');
  const figures = await page.$$eval('figure .missing', (all) => all.map((one) => one.textContent).join('\n'));
  check(bad.length === 0 || bad.some((cell) => figures.includes(cell.reason.slice(0, 40))), 'a failed cell stands at the figure with its reason');
  await accessible(page, 'light');
  check(problems.length === 0, 'still no console message and no request', problems);
  await page.evaluate(() => scrollTo(0, 0));
  await shoot(page, 'wide_light');
  await page.locator('#explore').scrollIntoViewIfNeeded();
  await page.evaluate(() => document.getElementById('explore').scrollIntoView());
  await shoot(page, 'wide_light_explore');
  await page.evaluate(() => document.getElementById('comparison').scrollIntoView());
  await shoot(page, 'wide_light_comparison');
});

await with_page({ colorScheme: 'dark' }, async (page, problems) => {
  await ready(page);
  const colours = await page.evaluate(() => [getComputedStyle(document.body).backgroundColor, getComputedStyle(document.body).color]);
  const brightness = colours.map((text) => text.match(/\d+/g).slice(0, 3).reduce((sum, c) => sum + Number(c), 0));
  check(brightness[0] < 150 && brightness[1] > 600, 'dark on request', colours);
  await accessible(page, 'dark');
  check(problems.length === 0, 'no console message in the dark', problems);
  await page.evaluate(() => document.getElementById('explore').scrollIntoView());
  await shoot(page, 'wide_dark_explore');
  await page.evaluate(() => document.getElementById('comparison').scrollIntoView());
  await shoot(page, 'wide_dark_comparison');
});

await with_page({ viewport: { width: 400, height: 800 } }, async (page) => {
  await ready(page);
  const extent = await page.evaluate(() => document.documentElement.scrollWidth);
  check(extent <= 400, 'at 400 pixels nothing is wider than the screen', extent);
  await accessible(page, 'narrow');
  await shoot(page, 'narrow_light');
  await page.evaluate(() => document.getElementById('explore').scrollIntoView());
  await shoot(page, 'narrow_light_explore');
  await page.evaluate(() => document.getElementById('comparison').scrollIntoView());
  await shoot(page, 'narrow_light_comparison');
});

await with_page({ javaScriptEnabled: false }, async (page) => {
  check(await page.isHidden('#explore'), 'without scripts no explorer');
  const n_figures = await page.locator('figure svg').count();
  check(n_figures > 1, 'without scripts there are figures', n_figures);
  const box = await page.locator('figure svg').first().boundingBox();
  check(box.width > 300 && box.height > 150, 'and they have a size', box);
  check(await page.locator('#comparison tbody tr').count() >= results.cells.length, 'without scripts every cell stands in a table');
  check(await page.locator('.scripted:visible').count() === 0, 'without scripts nothing promises them');
  await shoot(page, 'no_scripts');
});

process.exit(n_failed === 0 ? 0 : 1);
