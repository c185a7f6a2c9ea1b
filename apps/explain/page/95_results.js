chapter({
  id: "results", title: "Your results", kicker: "Exercises",
  lead: () => "The answers to the exercises of this page. The file for a teacher has one row per exercise: the question, the answer given, the expected one, the number of tries, and whether the answer was revealed.",
  steps: () => [{name: "Progress", caption: "For each chapter, the number of solved exercises and of tries. The progress belongs to this page, and is kept in this browser only.", draw: resultsPicture}],
});
